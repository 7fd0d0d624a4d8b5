#include "analysis/indicators/indicator_places.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/indicators/order_bands.hpp"
#include "analysis/order/same_order.hpp"
#include "hal/types/measure.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {
namespace {

template <typename Place>
std::vector<std::string> names_of(const std::vector<Place>& places) {
  std::vector<std::string> names;
  for (const Place& place : places) names.push_back(place.name);
  return names;
}

}  // namespace

double slip_of(const CharacteristicOrder& order, const Kinematics& kinematics) {
  double slip = 0;
  for (const Signature& s : kinematics.signatures) {
    if (std::abs(s.order - order.order) < same_order) slip = std::max(slip, s.slip);
  }
  return slip;
}

std::vector<CharacteristicOrder> locked_orders(const Kinematics& kinematics) {
  std::vector<CharacteristicOrder> locked;
  for (const CharacteristicOrder& o : kinematics.orders) {
    if (slip_of(o, kinematics) == 0) locked.push_back(o);
  }
  return locked;
}

std::vector<SidebandPlace> sideband_places(const Kinematics& kinematics) {
  std::vector<SidebandPlace> places;
  const std::vector<CharacteristicOrder> locked = locked_orders(kinematics);
  for (const CharacteristicOrder& mesh : locked) {
    if (!mesh.mesh) continue;
    std::vector<double> taken;
    for (const CharacteristicOrder& side : locked) {
      const auto same = [&](double order) { return std::abs(order - side.order) < same_order; };
      if (side.mesh || std::ranges::any_of(taken, same)) continue;
      taken.push_back(side.order);
      places.push_back({mesh.name + " at " + side.name, mesh, side.order});
    }
  }
  return places;
}

std::vector<GearPlace> gear_places(const Kinematics& kinematics) {
  std::vector<GearPlace> places;
  for (const GearMesh& mesh : kinematics.meshes) {
    for (const MeshingGear& gear : mesh.gears) {
      places.push_back({mesh.name + ", " + gear.shaft, mesh.name, gear});
    }
  }
  return places;
}

std::vector<std::string> places_of(std::string_view measure, const Kinematics& kinematics) {
  namespace names = measure_names;
  if (measure.starts_with("band_")) return names_of(order_bands(kinematics));
  if (measure == names::order_level) return names_of(locked_orders(kinematics));
  if (measure == names::sideband_ratio) return names_of(sideband_places(kinematics));
  if (measure == names::envelope_order_level) return names_of(kinematics.orders);
  if (measure == names::fm0 || measure == names::fm4 || measure == names::na4)
    return names_of(gear_places(kinematics));
  if (measure == names::torque_ripple) {
    return {std::string(channel_names::input_torque), std::string(channel_names::output_torque)};
  }
  return {};
}

}  // namespace rvbench::analysis
