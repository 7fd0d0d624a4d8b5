#include "hal/formats/time_column.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "hal/formats/even_grid.hpp"
#include "hal/formats/si_unit.hpp"

namespace rvbench::hal::formats {
namespace {

constexpr Eigen::Index fewest_nameless = 16;  // fewer may rise evenly by chance

constexpr std::string_view separators = "_ [](),";
constexpr std::array<std::string_view, 5> time_names = {"time", "times", "t", "ts", "seconds"};

// In lower case, without blanks, brackets and underscores.
std::string plain(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (separators.find(c) != std::string_view::npos) continue;
    out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return out;
}

std::optional<double> seconds_in(std::string_view unit) {
  const std::optional<SiUnit> si = si_unit(unit);
  return si && si->symbol == "s" ? std::optional<double>(si->factor) : std::nullopt;
}

void give_rate(double rate_Hz, Recording& table) {
  for (Channel& channel : table.channels) channel.rate_Hz = rate_Hz;
}

}  // namespace

std::optional<double> seconds_per_unit(std::string_view name) {
  while (name.ends_with(']') || name.ends_with(')')) name.remove_suffix(1);
  const std::size_t before = name.find_last_of(separators);
  return before == name.npos ? std::nullopt : seconds_in(name.substr(before + 1));
}

std::optional<double> time_unit_s(std::string_view name) {
  const std::string_view word = name.substr(0, name.find_first_of(separators));
  if (std::ranges::find(time_names, plain(word)) == time_names.end()) return std::nullopt;
  const std::string unit = plain(name.substr(word.size()));
  return unit.empty() ? std::optional<double>(1) : seconds_in(unit);
}

bool only_rises(const Eigen::VectorXd& x) {
  const Eigen::Index n = x.size();
  if (n < 2 || !(x[n - 1] > x[0])) return false;
  return ((x.tail(n - 1) - x.head(n - 1)).array() >= 0).all();
}

bool states_time_unit(std::string_view name) {
  const std::string_view word = name.substr(0, name.find_first_of(separators));
  return !plain(name.substr(word.size())).empty();
}

void set_rate_by_time_column(bool has_names, Recording& table) {
  for (const Channel& column : table.channels) {
    const Eigen::VectorXd& x = column.samples;
    const std::string& name = column.info.name;
    const auto unit_s = has_names ? time_unit_s(name) : std::optional<double>(1);
    const std::optional<double> step = unit_s ? even_step(x) : std::nullopt;
    const bool is_time = step && (has_names || (x[0] == 0 && x.size() >= fewest_nameless));
    if (is_time && has_names && states_time_unit(name))
      return give_rate(1 / (*step * *unit_s), table);
    if (is_time && *step <= longest_unstated_step) {
      table.notes.push_back(
          fmt::format("rate {:.6g} Hz from {}, taken as time in s", 1 / *step, name));
      return give_rate(1 / *step, table);
    }
    if (is_time && has_names) {
      table.notes.push_back(fmt::format(
          "{} states no unit: its steps of {:.6g} are {:.6g} Hz if in s, {:.6g} Hz if in ms", name,
          *step, 1 / *step, 1000 / *step));
      return;
    }
    if (!has_names) return;
  }
}

void drop_time_column(Recording& table) {
  if (table.channels.size() < 2) return;
  for (std::size_t i = 0; i < table.channels.size(); ++i) {
    const Channel time = table.channels[i];
    const std::optional<double> unit_s = time_unit_s(time.info.name);
    const std::optional<double> step = unit_s ? even_step(time.samples) : std::nullopt;
    const bool says_rate = step && std::ranges::all_of(table.channels, [&](const Channel& other) {
                             return other.samples.size() == time.samples.size() &&
                                    std::abs(other.rate_Hz * *step * *unit_s - 1) < 1e-9;
                           });
    if (!says_rate) continue;
    table.channels.erase(table.channels.begin() + static_cast<std::ptrdiff_t>(i));
    for (Channel& channel : table.channels) channel.start_s = time.samples[0] * *unit_s;
    return;
  }
}

}  // namespace rvbench::hal::formats
