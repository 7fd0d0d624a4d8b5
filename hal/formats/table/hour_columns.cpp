#include "hal/formats/table/hour_columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "hal/formats/even_grid.hpp"
#include "hal/formats/table/text.hpp"

namespace rvbench::hal::formats {
namespace {

struct ClockHand {
  std::array<std::string_view, 5> names;  // in lower case
  double seconds = 0;
  double below = 0;  // its values are whole, from 0
};

constexpr std::array hands = {
    ClockHand{{"hour", "hours", "hh", "h", "hr"}, 3600, 24},
    ClockHand{{"minute", "minutes", "min", "mm", "m"}, 60, 60},
    ClockHand{{"second", "seconds", "sec", "ss", "s"}, 1, 61},
    ClockHand{{"microsecond", "microseconds", "us", "usec", "µs"}, 1e-6, 1e6},
    ClockHand{{"millisecond", "milliseconds", "ms", "msec", "msecs"}, 1e-3, 1e3},
};
constexpr std::size_t parts_of_second = 3;  // the first of the hands below a second

bool is_called(const std::string& name, const ClockHand& hand) {
  return std::ranges::find(hand.names, lower_case(name)) != hand.names.end();
}

bool runs_like(const Eigen::VectorXd& x, const ClockHand& hand) {
  return std::ranges::all_of(x, [&](double value) {
    return value >= 0 && value < hand.below && value == std::floor(value);
  });
}

// What the first columns say if they are these hands.
ClockRows joined(const Table& table, const std::array<const ClockHand*, 4>& of) {
  ClockRows rows;
  for (Eigen::Index row = 0; row < table.columns.front().samples.size(); ++row) {
    double seconds = 0;
    for (std::size_t i = 0; i < of.size(); ++i) {
      seconds += of[i]->seconds * table.columns[i].samples[row];
    }
    ClockReading reading;
    reading.of_day_ns = std::llround(1e9 * seconds);
    rows.add(reading, reading);
  }
  return rows;
}

bool rises_evenly(const ClockRows& rows) {
  const auto times = rows.times(DateOrder::not_stated);
  const auto* found = std::get_if<ClockRows::Times>(&times);
  return found != nullptr && even_step(found->since_first_s);
}

std::optional<ClockRows> clock_in_first_columns(const Table& table) {
  for (std::size_t last = parts_of_second; last < hands.size(); ++last) {
    const std::array<const ClockHand*, 4> of = {&hands[0], &hands[1], &hands[2], &hands[last]};
    bool runs = true, named = true, unnamed = true;
    for (std::size_t i = 0; i < of.size(); ++i) {
      runs = runs && runs_like(table.columns[i].samples, *of[i]);
      named = named && is_called(table.columns[i].name, *of[i]);
      unnamed = unnamed && table.columns[i].name.empty();
    }
    if (!runs || !(named || unnamed)) continue;
    ClockRows rows = joined(table, of);
    if (named || rises_evenly(rows)) return rows;
  }
  return std::nullopt;
}

}  // namespace

bool join_hour_columns(Table& table) {
  constexpr std::size_t count = 4;
  if (table.columns.size() <= count || table.columns.front().samples.size() < 2) return false;
  if (table.clock) return false;
  table.clock = clock_in_first_columns(table);
  if (!table.clock) return false;
  table.columns.erase(table.columns.begin(), table.columns.begin() + count);
  return true;
}

}  // namespace rvbench::hal::formats
