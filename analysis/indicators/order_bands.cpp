#include "analysis/indicators/order_bands.hpp"

#include <algorithm>

#include "analysis/order/same_order.hpp"

namespace rvbench::analysis {
namespace {

constexpr double half_width = 3.5;  // three sidebands of the input shaft, and half-way to the next
constexpr double harmonics = 4.5;   // four, likewise

std::vector<CharacteristicOrder> meshes_by_order(const Kinematics& kinematics) {
  std::vector<CharacteristicOrder> meshes;
  for (const CharacteristicOrder& o : kinematics.orders) {
    if (o.mesh) meshes.push_back(o);
  }
  std::ranges::stable_sort(meshes, {}, &CharacteristicOrder::order);
  const auto is_double = [](const CharacteristicOrder& a, const CharacteristicOrder& b) {
    return b.order - a.order < same_order;
  };
  meshes.erase(std::unique(meshes.begin(), meshes.end(), is_double), meshes.end());
  return meshes;
}

}  // namespace

std::vector<OrderBand> order_bands(const Kinematics& kinematics) {
  if (kinematics.orders.empty()) return {};
  const std::vector<CharacteristicOrder> meshes = meshes_by_order(kinematics);
  if (meshes.empty()) {
    const double highest =
        std::ranges::max(kinematics.orders, {}, &CharacteristicOrder::order).order;
    return {{"characteristic orders", 0, harmonics * highest},
            {"above the characteristic orders", harmonics * highest}};
  }
  std::vector<OrderBand> bands;
  double from = std::max(0.0, meshes.front().order - half_width);
  if (from > 0) bands.push_back({"below the meshes", 0, from});
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const bool last = i + 1 == meshes.size();
    const double to =
        last ? meshes[i].order + half_width : (meshes[i].order + meshes[i + 1].order) / 2;
    bands.push_back({meshes[i].name, from, to});
    from = to;
  }
  bands.push_back({"above the meshes", from});
  return bands;
}

}  // namespace rvbench::analysis
