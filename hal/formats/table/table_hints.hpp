#pragma once

#include <cstddef>

namespace rvbench::hal::formats {

/// Which number of 01/02/2026 is the day.
enum class DateOrder { not_stated, day_month, month_day };

/// What a user knows of a table in text. It overrides what is found.
struct TableHints {
  std::size_t head_line = 0;  ///< of the columns' names; 0: not stated
  char separator = '\0';      ///< ' ' for blanks; '\0': not stated
  char decimal = '\0';        ///< '.' or ','; '\0': not stated
  DateOrder dates = DateOrder::not_stated;
};

}  // namespace rvbench::hal::formats
