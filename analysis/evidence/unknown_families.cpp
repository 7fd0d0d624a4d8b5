#include "analysis/evidence/unknown_families.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "analysis/evidence/same_speed.hpp"
#include "analysis/order/resolution.hpp"

namespace rvbench::analysis {
namespace {

// Where one point shows a family.
struct Seen {
  double spacing = 0;
  double speed_rpm = 0;
};

// True if one record shows as many harmonics as damage has. Jitter smears the higher ones, so an
// order that returns at another speed counts as well. What stands still in Hz does not return.
bool has_harmonics(const UnknownFamily& family, const std::vector<Seen>& seen) {
  constexpr double same_slip = 0.005;  // relative: of one bearing in one machine
  if (family.harmonics >= harmonics_of_damage) return true;
  return std::ranges::any_of(seen, [&](const Seen& one) {
    return std::ranges::any_of(seen, [&](const Seen& other) {
      return !is_same_speed(one.speed_rpm, other.speed_rpm) &&
             std::abs(one.spacing - other.spacing) < same_slip * one.spacing;
    });
  });
}

// A family that most of the points show, at one order but for slip.
std::vector<UnknownFamily> struck_families(const std::vector<Examination>& points) {
  constexpr double slip = 0.03;
  std::vector<UnknownFamily> families;
  std::vector<std::vector<Seen>> seen;  // of each, in the points that show it
  std::size_t resolvable = 0;
  for (const Examination& point : points) {
    resolvable += point.resolvable ? 1 : 0;
    for (const UnknownFamily& found : point.unknown) {
      const auto same = std::ranges::find_if(families, [&](const UnknownFamily& family) {
        return std::abs(family.spacing - found.spacing) < slip * family.spacing;
      });
      const auto index = static_cast<std::size_t>(same - families.begin());
      if (same == families.end()) {
        families.push_back(found);
        seen.emplace_back();
      }
      UnknownFamily& family = families[index];
      seen[index].push_back({found.spacing, point.speed_rpm});
      family.points.push_back(point.source);
      family.harmonics = std::max(family.harmonics, found.harmonics);
      family.severity = std::max(family.severity, found.severity);
      family.p_value = std::min(family.p_value, found.p_value);
    }
  }
  std::vector<UnknownFamily> shown;
  for (std::size_t i = 0; i < families.size(); ++i) {
    const bool by_most = 2 * families[i].points.size() >= resolvable;
    if (by_most && has_harmonics(families[i], seen[i])) shown.push_back(std::move(families[i]));
  }
  return shown;
}

// Lines of the signal itself that modulate a mesh and have many harmonics, which no single tone, no
// mains and no inverter does. A family at a multiple of a known part's order is that part's.
bool is_damage_like(const SpectralLine& family, const Diagnosis& d, const Kinematics& kinematics) {
  constexpr int fewest_sidebands = 2;
  constexpr double same = 2e-3;  // relative
  const bool is_known = std::ranges::any_of(kinematics.orders, [&](const CharacteristicOrder& o) {
    return is_multiple(family.order, o.order, same);
  });
  // Blows that slip are the bearing's that was found.
  constexpr double jitter = 0.01;
  const auto hypotheses = d.hypotheses();
  const bool is_found = std::ranges::any_of(hypotheses, [&](const Finding* f) {
    return !f->points.empty() && is_multiple(family.order, f->order, jitter);
  });
  return !is_known && !is_found && family.harmonics >= harmonics_of_damage &&
         family.sidebands >= fewest_sidebands;
}

UnknownFamily unknown_family(const SpectralLine& family, const std::vector<Examination>& points) {
  UnknownFamily unknown{.spacing = family.order,
                        .harmonics = family.harmonics,
                        .sidebands = family.sidebands,
                        .p_value = family.p_value};
  for (const Examination& point : points) unknown.points.push_back(point.source);
  return unknown;
}

}  // namespace

std::vector<UnknownFamily> unknown_families(const std::vector<Examination>& points,
                                            const Diagnosis& d, const Kinematics& kinematics) {
  std::vector<UnknownFamily> families = struck_families(points);
  for (const SpectralLine& family : d.unexplained) {
    if (is_damage_like(family, d, kinematics)) families.push_back(unknown_family(family, points));
  }
  return families;
}

}  // namespace rvbench::analysis
