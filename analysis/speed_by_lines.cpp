#include "analysis/speed_by_lines.hpp"

#include <Eigen/Core>
#include <cmath>
#include <utility>

#include "analysis/order/order_lines.hpp"
#include "analysis/order/resolution.hpp"
#include "analysis/shaft_speed.hpp"

namespace rvbench::analysis {
namespace {

// Lines that may tell the speed: the meshes' first harmonics; as their paths spread them where
// equal planets cancel them; and their second.
std::vector<std::vector<double>> witnesses_of(const Kinematics& kinematics, double top_order) {
  std::vector<double> first, beside, second;
  for (const GearMesh& mesh : kinematics.meshes) {
    if (2 * mesh.order + 1 > top_order) continue;
    first.push_back(mesh.order);
    second.push_back(2 * mesh.order);
    if (!(mesh.path_order > 0)) continue;
    beside.push_back(mesh.order - mesh.path_order);
    beside.push_back(mesh.order + mesh.path_order);
  }
  std::vector<std::vector<double>> witnesses;
  for (const std::vector<double>& orders : {first, second, beside}) {
    if (!orders.empty()) witnesses.push_back(orders);
  }
  if (first.size() > 1) {
    for (const double alone : first) witnesses.push_back({alone});  // the others may be silent
  }
  return witnesses;
}

}  // namespace

std::optional<ShaftAngle> corrected_by_lines(const std::vector<const Channel*>& channels,
                                             const ShaftAngle& stated,
                                             const Kinematics& kinematics) {
  std::vector<Channel> alike;
  for (const Channel* channel : channels) {
    if (alike.empty() || (channel->samples.size() == alike.front().samples.size() &&
                          channel->rate_Hz == alike.front().rate_Hz)) {
      alike.push_back(*channel);
    }
  }
  if (alike.empty()) return {};
  const double rate_Hz = alike.front().rate_Hz;
  const Eigen::Index samples = alike.front().samples.size();
  constexpr Eigen::Index fewest_samples = 4096;  // some turns: of fewer no line is a line
  if (samples < fewest_samples) return {};
  const double top_order = OrderLines::top_order_of(rate_Hz, stated);
  const double turns = stated.mean_speed_Hz() * static_cast<double>(samples) / rate_Hz;
  for (std::vector<double>& orders : witnesses_of(kinematics, top_order)) {
    const ShaftLines lines{.orders = std::move(orders),
                           .turns_per_sample = stated.mean_speed_Hz() / rate_Hz,
                           .within = 2 * stated_speed_error};
    const std::vector<ShaftSpeed> found = shaft_speeds(alike, lines, samples);
    if (found.empty() || !std::isfinite(found.front().turns_per_sample)) continue;
    const double off = found.front().standard_error / found.front().turns_per_sample;
    if (!(off * top_order * turns < same_line)) continue;
    return stated.geared(found.front().turns_per_sample / lines.turns_per_sample);
  }
  return {};
}

}  // namespace rvbench::analysis
