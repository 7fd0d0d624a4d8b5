#include "analysis/table4.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

constexpr std::array<Table4Row, 7> rows = {{
    {"Drive shaft frequency", "input_shaft", {10.0, 20.0, 30.0}},
    {"Planetary gear meshing frequency", "sun_gear", {87.3, 175.5, 263.7}},
    {"Cycloid meshing frequency", "cycloid_disc", {3.2, 6.4, 9.5}},
    {"Pin tooth meshing frequency", "pin_housing", {6.5, 13.0, 19.5}},
    {"Pin tooth shell characteristic frequency", "pin_housing", {0.2, 0.3, 0.5}},
    {"Cycloidal gear rotation frequency", "cycloid_disc", {0.1, 0.2, 0.3}},
    {"Planetary gear rotation frequency", "planet_gear", {3.2, 6.4, 9.5}},
}};

constexpr double rounding_Hz = 0.05;
constexpr double least_matched_Hz = 1;
// The published table gives no limits; this is the depth that counts as plain modulation.
constexpr double published_depth_limit = 0.2;

std::size_t nearest_column(double speed_rpm) {
  std::size_t nearest = 0;
  for (std::size_t column = 1; column < table4_speeds_rpm.size(); ++column) {
    if (std::abs(speed_rpm - table4_speeds_rpm[column]) <
        std::abs(speed_rpm - table4_speeds_rpm[nearest])) {
      nearest = column;
    }
  }
  return nearest;
}

}  // namespace

const std::array<Table4Row, 7>& table4() { return rows; }

Kinematics published_table4(double speed_rpm) {
  if (!std::isfinite(speed_rpm)) {
    throw std::invalid_argument("published_table4: speed_rpm is not finite");
  }
  const std::size_t column = nearest_column(speed_rpm);
  const double shaft_Hz = units::Hz_from_rpm(table4_speeds_rpm[column]);
  Kinematics kinematics;
  kinematics.machine = "RV-20E, Table 4 as published";
  kinematics.period_turns = 121;
  for (const Table4Row& row : rows) {
    const double order = row.frequency_Hz[column] / shaft_Hz;
    kinematics.orders.push_back(
        {std::string(row.item), order, "", std::string(row.component), std::string(row.item)});
    if (row.frequency_Hz[0] < least_matched_Hz) continue;
    Signature signature;
    signature.component = row.component;
    signature.mechanism = "unknown";
    signature.table4_item = row.item;
    signature.order = order;
    signature.shows = Shows::as_printed;
    signature.tolerance = rounding_Hz / row.frequency_Hz[column];
    signature.depth_limit = published_depth_limit;
    signature.limit_why = "Table 4 states no limit; plain modulation";
    signature.advice = "Compare with the derived catalogue: Table 4 mixes motor speeds.";
    kinematics.signatures.push_back(signature);
  }
  return kinematics;
}

}  // namespace rvbench::analysis
