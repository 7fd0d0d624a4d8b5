#include "analysis/evidence/gear_places.hpp"

#include <algorithm>

#include "analysis/evidence/gear_combs.hpp"
#include "analysis/order/resolution.hpp"
#include "analysis/signature_lines.hpp"

namespace rvbench::analysis {
namespace {

using Index = Eigen::Index;

constexpr double hann_reach = 1.5;  // lines: further away a line has below 3 % of its power
// The speed of a drive wanders by some thousandths within a second or two.
constexpr double wander_Hz = 0.6;

void mark_lines(const Kinematics& kinematics, std::size_t lines, GearPlaces& places) {
  places.locked = locked_lines(kinematics, places.resolution, lines, hann_reach);
  for (std::size_t i = 2; i + 1 < lines; ++i) {
    if (!places.locked[i]) places.free.push_back(static_cast<Index>(i));
  }
  for (std::size_t i = 0, before = 0; i < lines; ++i) {
    places.free_before.push_back(static_cast<Index>(before));
    if (before < places.free.size() && places.free[before] == static_cast<Index>(i)) ++before;
  }
}

}  // namespace

GearPlaces line_places(double turns, double top_order, double speed_Hz, bool is_placed,
                       const Kinematics& kinematics) {
  GearPlaces places;
  places.resolution = 1 / turns;
  constexpr double rounding = 0.99;
  places.parts = own_lines(kinematics, rounding * lines_to_part * places.resolution,
                           wander_Hz / speed_Hz, top_order);
  // Beyond it a stated speed places no line.
  const double error = speed_error(is_placed);
  const double placed = error > 0 ? 0.5 * places.resolution / error : top_order;
  for (std::size_t s = 0; s < places.parts.size(); ++s) {
    PartLines& part = places.parts[s];
    const double turn = kinematics.signatures[s].turn;
    std::erase_if(part.own, [&](const OwnLine& line) { return line.order > placed; });
    std::erase_if(part.turn_lines, [&](int h) { return h * turn > placed; });
    if (part.mesh.empty() || part.contact_order <= placed) continue;
    part.own.clear();
    part.turn_lines.clear();
  }
  mark_lines(kinematics, static_cast<std::size_t>(top_order / places.resolution), places);
  return places;
}

GearPlaces envelope_places(const Kinematics& kinematics, double resolution, std::size_t lines) {
  GearPlaces places;
  places.resolution = resolution;
  for (const auto& part : signature_lines(kinematics, resolution)) {
    PartLines& own = places.parts.emplace_back();
    const auto s = places.parts.size() - 1;
    const Shows shows = kinematics.signatures[s].shows;
    if (shows == Shows::as_blows || shows == Shows::as_printed) continue;
    for (const SignatureLine& line : part) own.own.push_back({line.order, line.rivals});
  }
  mark_lines(kinematics, lines, places);
  return places;
}

}  // namespace rvbench::analysis
