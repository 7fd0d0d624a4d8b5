#pragma once

#include <array>
#include <string_view>

#include "analysis/kinematics.hpp"

namespace rvbench::analysis {

/// One row of the article's Table 4, "Main excitation frequency of RV-20E reducer", as published.
struct Table4Row {
  std::string_view item;
  std::string_view component;          ///< the part, in rvbench's words
  std::array<double, 3> frequency_Hz;  ///< at table4_speeds_rpm
};

inline constexpr std::array<double, 3> table4_speeds_rpm = {605, 1210, 1815};

/// The seven rows, in the order of print. They mix speeds: the meshing row fits a motor 2.3 to 3 %
/// below nominal, the others fit the nominal speed. What is printed as the drive shaft is 120/121
/// of it: the sun against the carrier.
/// Shape, units  7 rows by 3 speeds, Hz. Errors  none thrown. Source  the article, Table 4
const std::array<Table4Row, 7>& table4();

/// Table 4 as a catalogue: the published Hz of the column nearest to `speed_rpm`, as orders of that
/// column's nominal speed. Rows are the same, and in the same order, for every speed.
///
/// Limits  rows printed below 1 Hz have one digit; they are listed but have no signature, for a
///         search as wide as their rounding would match neighbours
/// Errors  throws std::invalid_argument if speed_rpm is not finite
/// Units   orders. Source  the article, Table 4
Kinematics published_table4(double speed_rpm);

}  // namespace rvbench::analysis
