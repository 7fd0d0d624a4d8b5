#include "bench/rising_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/quality.hpp"
#include "analysis/statistics.hpp"
#include "bench/lost_rows.hpp"
#include "hal/formats/time_column.hpp"

namespace rvbench::bench {
namespace {

constexpr Eigen::Index fewest_samples = 100;  // fewer may rise by chance
// Of the whole rise: a clock's drift and the rounding of a printed time stay below, a lost block
// of samples does not.
constexpr double most_bend = 1e-3;
constexpr double one_rate = 1e-3;     // relative: less is the same
constexpr double longest_step = 1.5;  // of the usual one, where rows are too few for more
constexpr const char* other_way = "; if it is no time, name what to judge with --channel";

bool is_even(const Eigen::VectorXd& x) {
  const double rise = x[x.size() - 1] - x[0];
  const Eigen::VectorXd line = Eigen::VectorXd::LinSpaced(x.size(), x[0], x[x.size() - 1]);
  return (x - line).cwiseAbs().maxCoeff() <= most_bend * rise;
}

// Why the times of a column are none of even samples; empty if they are.
std::string what_is_uneven(const Eigen::VectorXd& x) {
  if (const std::optional<LostRows> lost = find_lost_rows(x)) {
    const double count = std::round(lost->count);
    return fmt::format("about {:.0f} sample{} missing behind its sample {} ({:.6g})", count,
                       count > 1 ? "s are" : " is", lost->before, x[lost->before - 1]);
  }
  return is_even(x) ? "" : "samples are missing or of several rates";
}

std::string unevenly(const std::string& name, const std::string& uneven) {
  return name + " only rises, as time does, but unevenly: " + uneven;
}

// Of a column that does not only rise.
std::string not_rising(const Channel& column) {
  const Eigen::VectorXd& x = column.samples;
  Eigen::Index at = 1;
  while (at + 1 < x.size() && x[at] >= x[at - 1]) ++at;
  return fmt::format(
      "{} is named as time but does not only rise: {:.6g} follows {:.6g} in sample {}",
      column.info.name, x[at], x[at - 1], at + 1);
}

bool may_be_time(const Eigen::VectorXd& x) {
  return x.size() >= fewest_samples && hal::formats::only_rises(x);
}

// "; in seconds it says 2000 Hz", and what is taken in place of that.
std::string stated_rate(const Channel& column) {
  const Eigen::VectorXd& x = column.samples;
  const std::optional<double> unit_s = hal::formats::seconds_per_unit(column.info.name);
  const double rate_Hz =
      static_cast<double>(x.size() - 1) / (x[x.size() - 1] - x[0]) / unit_s.value_or(1);
  const bool is_clock = unit_s || hal::formats::time_unit_s(column.info.name);
  const bool other = column.rate_Hz > 0 && std::abs(rate_Hz / column.rate_Hz - 1) > one_rate;
  return fmt::format("; {} it says {:.6g} Hz{}", unit_s ? "by the unit in its name" : "in seconds",
                     rate_Hz,
                     is_clock && other ? fmt::format(", not {:.6g} Hz", column.rate_Hz) : "");
}

// A column that is surely meant as time, and is none.
bool is_broken_clock(const Channel& column) {
  const std::string& name = column.info.name;
  constexpr std::size_t longest_symbol = 2;  // "t" and "ts" may be anything's
  return name.size() > longest_symbol && hal::formats::time_unit_s(name) &&
         column.samples.size() >= fewest_samples && !hal::formats::only_rises(column.samples);
}

bool rises_in_seconds(const Channel& column) {
  return column.info.unit == "s" && hal::formats::only_rises(column.samples);
}

// Whether the channel tells when the rows of others were: by its name, as the first of a table
// without names, or for it rises in seconds.
bool is_clock_of_rows(const Channel& column, const Recording& record) {
  const std::string& name = column.info.name;
  const bool is_clock = hal::formats::time_unit_s(name) || hal::formats::seconds_per_unit(name) ||
                        name == hal::formats::first_without_name || rises_in_seconds(column);
  return is_clock && std::ranges::any_of(record.channels, [&column](const Channel& other) {
           return &other != &column && other.samples.size() == column.samples.size();
         });
}

// Why the times of a column that is surely time are none of even samples, where rows are too few
// for means: by its longest step.
std::string what_is_uneven_in_few(const Channel& column) {
  const Eigen::VectorXd& x = column.samples;
  const bool is_time = hal::formats::time_unit_s(column.info.name) || column.info.unit == "s";
  if (x.size() < 3 || !is_time || !hal::formats::only_rises(x)) return "";
  const Eigen::VectorXd steps = x.tail(x.size() - 1) - x.head(x.size() - 1);
  Eigen::Index at = 0;
  const double longest = steps.maxCoeff(&at);
  const double usual = analysis::median({steps.begin(), steps.end()});
  if (!(usual > 0) || longest < longest_step * usual) return "";
  return fmt::format("samples are missing behind its sample {} ({:.6g})", at + 1, x[at]);
}

}  // namespace

std::optional<std::string> what_breaks_the_clock(Recording& record) {
  for (const Channel& column : record.channels) {
    if (is_of_shaft(column.info)) continue;
    const Eigen::VectorXd& x = column.samples;
    const std::string& name = column.info.name;
    const bool is_clock = is_clock_of_rows(column, record);
    if (is_clock && is_broken_clock(column)) return not_rising(column);
    std::string uneven;
    if (may_be_time(x)) {
      uneven = what_is_uneven(x);
    } else if (is_clock && x.size() < fewest_samples) {
      uneven = what_is_uneven_in_few(column);
    }
    if (uneven.empty()) continue;
    if (is_clock) return unevenly(name, uneven);
    record.notes.push_back(unevenly(name, uneven));
  }
  return std::nullopt;
}

std::optional<std::string> leave_out_rising_channels(const std::string& kept, Recording& record) {
  std::vector<std::string> rising;
  for (const Channel* channel : analysis::acceleration_channels(record)) {
    const std::string& name = channel->info.name;
    const Eigen::VectorXd& x = channel->samples;
    if (name == kept) continue;
    if (kept.empty() && is_broken_clock(*channel)) return not_rising(*channel) + other_way;
    if (!may_be_time(x)) continue;
    const std::string uneven = what_is_uneven(x);
    if (!uneven.empty() && kept.empty()) return unevenly(name, uneven) + other_way;
    record.notes.push_back(
        fmt::format("{} only rises, as no vibration does, and is left out{}", name,
                    uneven.empty() ? stated_rate(*channel) : "; it rises unevenly: " + uneven));
    rising.push_back(name);
  }
  std::erase_if(record.channels, [&](const Channel& channel) {
    return std::ranges::find(rising, channel.info.name) != rising.end();
  });
  return std::nullopt;
}

}  // namespace rvbench::bench
