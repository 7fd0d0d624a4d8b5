#include "analysis/evidence/kinship.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/order/resolution.hpp"

namespace rvbench::analysis {
namespace {

constexpr double same_turn = 1e-9;  // relative

bool is_part_of(std::size_t signature, const RollingBearing& b) {
  return signature == b.inner || signature == b.outer || signature == b.ball ||
         signature == b.cage_wear;
}

// Equal planets meet a bad sun one after the other: in the housing its lines are whole multiples of
// its turn less those of the planets' passing, which a bad ring's lines are multiples of.
bool are_alike_by_planets(const Signature& sun, const Signature& ring) {
  if (sun.strikes || !ring.strikes || !(sun.path_order > 0) || ring.path_order > 0) return false;
  return is_multiple(ring.turn, sun.path_order, same_turn) &&
         is_multiple(sun.turn + sun.path_order, ring.turn, same_turn);
}

}  // namespace

bool turn_alike(const Signature& a, const Signature& b) {
  return a.turn > 0 && std::abs(a.turn - b.turn) <= same_turn * a.turn;
}

bool planets_hide(const Signature& a, const Signature& b) {
  return a.shows == Shows::as_teeth && b.shows == Shows::as_teeth &&
         (are_alike_by_planets(a, b) || are_alike_by_planets(b, a));
}

bool have_the_same_lines(const Signature& a, const Signature& b) {
  if (a.shows == Shows::as_printed) return b.shows == a.shows && a.order == b.order;
  if (planets_hide(a, b)) return true;
  return a.shows == Shows::as_teeth && b.shows == Shows::as_teeth && turn_alike(a, b);
}

bool is_gear_of(const GearMesh& mesh, double turn) {
  return std::ranges::any_of(mesh.gears, [&](const MeshingGear& gear) {
    return std::abs(gear.order - turn) <= same_turn * turn;
  });
}

bool share_a_mesh(std::size_t one, std::size_t other, const Kinematics& kinematics) {
  const Signature& a = kinematics.signatures[one];
  const Signature& b = kinematics.signatures[other];
  const auto has_sidebands = [](const Signature& s) {
    return s.shows == Shows::as_teeth || (s.shows == Shows::as_turning && s.turn > 0);
  };
  if (!has_sidebands(a) || !has_sidebands(b) || turn_alike(a, b)) return false;
  return std::ranges::any_of(kinematics.meshes, [&](const GearMesh& mesh) {
    return is_gear_of(mesh, a.turn) && is_gear_of(mesh, b.turn);
  });
}

bool may_follow_from(std::size_t lesser, std::size_t graver, const Kinematics& kinematics) {
  const Signature& consequence = kinematics.signatures[lesser];
  const Signature& cause = kinematics.signatures[graver];
  if (consequence.shows == Shows::as_turning && cause.shows == Shows::as_teeth) {
    return turn_alike(consequence, cause);
  }
  return std::ranges::any_of(kinematics.bearings, [&](const RollingBearing& bearing) {
    return is_part_of(lesser, bearing) && is_part_of(graver, bearing);
  });
}

}  // namespace rvbench::analysis
