#include <fmt/format.h>

#include <algorithm>

#include "bench/console.hpp"
#include "bench/limit_checks.hpp"
#include "bench/results/run_filter.hpp"
#include "bench/results/trend.hpp"

namespace rvbench::bench {
namespace {

constexpr const char* bars[] = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
constexpr int steps = 8;
constexpr std::size_t strip_columns = 60;
constexpr int bar_columns = 24;

// A bar as long as the value is far from the least to the greatest.
std::string bar_of(double value, double least, double greatest) {
  const double share = greatest > least ? (value - least) / (greatest - least) : 0;
  std::string bar;
  for (int i = 0; i < 1 + int(share * (bar_columns - 1) + 0.5); ++i) bar += "▪";
  return bar;
}

std::vector<double> numbers_of(const Trend& trend) {
  std::vector<double> numbers;
  for (const RunValue& value : trend.values) numbers.push_back(value.value);
  return numbers;
}

}  // namespace

std::string strip_of(const std::vector<double>& values, std::size_t columns) {
  if (values.empty()) return "";
  const auto [least, greatest] = std::ranges::minmax(values);
  const std::size_t shown = std::min(columns, values.size());
  std::string strip;
  for (std::size_t column = 0; column < shown; ++column) {
    const auto first = values.begin() + std::ptrdiff_t(column * values.size() / shown);
    const auto last = values.begin() + std::ptrdiff_t((column + 1) * values.size() / shown);
    const double value = *std::max_element(first, last);
    const double share = greatest > least ? (value - least) / (greatest - least) : 0;
    strip += bars[std::min(steps - 1, int(share * steps))];
  }
  return strip;
}

std::string trend_text(const Trend& trend) {
  std::string text = trend_title(trend) + ": the worst of each run\n";
  const std::vector<double> numbers = numbers_of(trend);
  if (numbers.empty()) return text + "no run has it\n";
  const auto [least, greatest] = std::ranges::minmax(numbers);
  for (const RunValue& value : trend.values) {
    text +=
        fmt::format("{:<19}  {:>12}  {:<7}  {:<{}}  {}\n", readable_utc(value.started_utc),
                    with_unit(value.value, value.unit), value.verdict,
                    bar_of(value.value, least, greatest), bar_columns, as_cell(value.serial, 32));
  }
  return text + fmt::format("{}  {} to {}\n{}\n", strip_of(numbers, strip_columns),
                            with_unit(least, trend.unit), with_unit(greatest, trend.unit),
                            trend_sentence(trend));
}

}  // namespace rvbench::bench
