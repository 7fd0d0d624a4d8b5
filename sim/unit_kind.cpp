#include "sim/unit_kind.hpp"

#include <array>
#include <cmath>

namespace rvbench::sim {
namespace {

struct Row {
  UnitKind kind;
  std::string_view rotation, translation;
  int force, coordinate, time;  // powers
};

constexpr std::array<Row, 25> rows{{
    {UnitKind::ratio, "1", "1", 0, 0, 0},
    {UnitKind::inertia, "kg·m²", "kg", 1, -1, 2},
    {UnitKind::force, "N·m", "N", 1, 0, 0},
    {UnitKind::stiffness, "N·m/rad", "N/m", 1, -1, 0},
    {UnitKind::quadratic_stiffness, "N·m/rad²", "N/m²", 1, -2, 0},
    {UnitKind::cubic_stiffness, "N·m/rad³", "N/m³", 1, -3, 0},
    {UnitKind::damping, "N·m·s/rad", "N·s/m", 1, -1, 1},
    {UnitKind::quadratic_damping, "N·m·s²/rad²", "N·s²/m²", 1, -2, 2},
    {UnitKind::coordinate, "rad", "m", 0, 1, 0},
    {UnitKind::speed, "rad/s", "m/s", 0, 1, -1},
    {UnitKind::acceleration, "rad/s²", "m/s²", 0, 1, -2},
    {UnitKind::frequency, "Hz", "Hz", 0, 0, -1},
    {UnitKind::time, "s", "s", 0, 0, 1},
    {UnitKind::angle, "rad", "rad", 0, 0, 0},
    {UnitKind::temperature, "K", "K", 0, 0, 0},
    {UnitKind::per_temperature, "1/K", "1/K", 0, 0, 0},
    {UnitKind::thermal_resistance, "K/W", "K/W", 0, 0, 0},
    {UnitKind::mass_offset, "kg·m", "kg·m", 1, 0, 2},
    {UnitKind::motor_constant, "N·m/A", "N/A", 0, 0, 0},
    {UnitKind::resistance, "Ω", "Ω", 0, 0, 0},
    {UnitKind::impulse, "N·m·s", "N·s", 1, 0, 1},
    {UnitKind::length, "m", "m", 0, 0, 0},
    {UnitKind::contact_stiffness, "N/m", "N/m", 0, 0, 0},
    {UnitKind::contact_damping, "N·s/m", "N·s/m", 0, 0, 0},
    {UnitKind::channel, "", "", 0, 0, 0},
}};

constexpr bool in_order() {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].kind != static_cast<UnitKind>(i)) return false;
  }
  return true;
}
static_assert(in_order());

const Row& row_of(UnitKind kind) { return rows[static_cast<std::size_t>(kind)]; }

}  // namespace

std::string_view unit_of(UnitKind kind, Motion motion) {
  return motion == Motion::rotation ? row_of(kind).rotation : row_of(kind).translation;
}

double natural_scale(UnitKind kind, const NaturalScales& scales) {
  const Row& row = row_of(kind);
  return std::pow(scales.force, row.force) * std::pow(scales.coordinate, row.coordinate) *
         std::pow(scales.coordinate / scales.speed, row.time);
}

}  // namespace rvbench::sim
