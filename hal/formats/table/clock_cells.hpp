#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hal/formats/table/table_hints.hpp"

namespace rvbench::hal::formats {

/// A date, a time of day, or both, as one cell holds them.
struct ClockReading {
  std::optional<std::array<int, 3>> date;  ///< numbers in their order; a month by name as number
  bool year_first = false;
  bool month_named = false;  ///< then the date is day, month, year
  std::optional<std::int64_t> of_day_ns;
};

/// Reads "2026-01-31", "31.12.2026", "12/31/2026", "31-Dec-2026", "10:30:25.001", "10:30:25,001",
/// "10:30:25 PM", and a date and a time parted by a blank or a T. A zone behind the time is passed
/// over: it is the same in all rows.
std::optional<ClockReading> clock_in(std::string_view cell);

/// The rows of one or two columns that say when a sample was taken.
class ClockRows {
 public:
  /// @param date, time  what the row's cells say; the same object if one cell says both
  void add(const ClockReading& date, const ClockReading& time);

  struct Times {
    Eigen::VectorXd since_first_s;
    double start_utc_s;  ///< NaN without a date
  };
  /// A time of day that falls by half a day or more has passed midnight.
  /// @return times, or why there are none: a date that can be read in two ways
  std::variant<Times, std::string> times(DateOrder stated) const;

 private:
  std::variant<DateOrder, std::string> order(DateOrder stated) const;

  std::vector<std::array<int, 3>> dates_;
  std::vector<std::int64_t> of_day_ns_;
  bool year_first_ = false, month_named_ = false;
};

}  // namespace rvbench::hal::formats
