#include "bench/rising_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "analysis/quality.hpp"

namespace rvbench::bench {
namespace {

constexpr Eigen::Index fewest_samples = 100;  // fewer may rise by chance
// Of the whole rise: a clock's drift and the rounding of a printed time stay below, a lost block
// of samples does not.
constexpr double most_bend = 1e-3;

// Steps of zero are the rounding of a printed time.
bool only_rises(const Eigen::VectorXd& x) {
  const Eigen::Index n = x.size();
  if (n < fewest_samples || !(x[n - 1] > x[0])) return false;
  return ((x.tail(n - 1) - x.head(n - 1)).array() >= 0).all();
}

bool is_even(const Eigen::VectorXd& x) {
  const double rise = x[x.size() - 1] - x[0];
  const Eigen::VectorXd line = Eigen::VectorXd::LinSpaced(x.size(), x[0], x[x.size() - 1]);
  return (x - line).cwiseAbs().maxCoeff() <= most_bend * rise;
}

// Seconds in the unit that the name of a column of time ends in; nothing if it ends in none.
std::optional<double> seconds_per_unit(std::string_view name) {
  while (!name.empty() && (name.ends_with(']') || name.ends_with(')'))) name.remove_suffix(1);
  const std::size_t before = name.find_last_of("_ [(");
  const std::string_view unit = before == std::string_view::npos ? "" : name.substr(before + 1);
  if (unit == "s") return 1;
  if (unit == "ms") return 1e-3;
  if (unit == "us" || unit == "µs") return 1e-6;
  if (unit == "ns") return 1e-9;
  return std::nullopt;
}

}  // namespace

std::optional<std::string> leave_out_rising_channels(const std::string& kept, Recording& record) {
  std::vector<std::string> rising;
  for (const Channel* channel : analysis::acceleration_channels(record)) {
    const std::string& name = channel->info.name;
    const Eigen::VectorXd& x = channel->samples;
    if (name == kept || !only_rises(x)) continue;
    const bool even = is_even(x);
    if (!even && kept.empty()) {
      return fmt::format(
          "{} only rises, as time does, but unevenly: samples are missing or of several rates; if "
          "it is no time, name what to judge with --channel",
          name);
    }
    const double per_unit = static_cast<double>(x.size() - 1) / (x[x.size() - 1] - x[0]);
    const std::optional<double> unit_s = seconds_per_unit(name);
    record.notes.push_back(
        fmt::format("{} only rises, as no vibration does, and is left out", name) +
        (even ? fmt::format("; {} it says {:.6g} Hz",
                            unit_s ? "by the unit in its name" : "in seconds",
                            per_unit / unit_s.value_or(1))
              : ""));
    rising.push_back(name);
  }
  std::erase_if(record.channels, [&](const Channel& channel) {
    return std::ranges::find(rising, channel.info.name) != rising.end();
  });
  return std::nullopt;
}

}  // namespace rvbench::bench
