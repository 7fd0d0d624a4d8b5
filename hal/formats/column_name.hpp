#pragma once

#include <string>
#include <string_view>

namespace rvbench::hal::formats {

/// What the head of a column says.
struct ColumnName {
  std::string
      name;  ///< of the signal: "a" of "a [g]"; the whole head if it names no unit in brackets
  std::string unit;  ///< as it is written: "g"; empty if the head names none
};

/// Parts a head into name and unit. A unit is
///
///     a [g]          what stands in square brackets at the end, also where it is not known here,
///                    unless it is an index or an axis: "a[1]", "a [x]"
///     a (mm/s)       in round ones what is known, for others stand there too: "a (drive end)"
///     a_mm/s, a_g    what is known and no word: "accel_in" and "a_rad" name none
///     a / g, "a, g"  what is known, behind the mark and a blank
ColumnName column_name(std::string_view head);

/// The name of a signal that is in `symbol` by now, without another unit of the same kind at its
/// end: "a" of "a_mm/s2" in m/s². As it is, if nothing is left without, or it names no other unit.
std::string name_in_unit(const std::string& name, std::string_view symbol);

}  // namespace rvbench::hal::formats
