#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/frf/signed_axis.hpp"
#include "analysis/tpa/blocked_forces.hpp"
#include "bench/tpa_by_inverse.hpp"

namespace rvbench::bench {
namespace {

constexpr double most_disagreement = 0.1;  // of the forces' power

class ByBlockedForces final : public ByInverse {
 public:
  ByBlockedForces(const TpaProject& project, const TpaFrfs& frfs, analysis::OperatingSpectra motion)
      : ByInverse(project, frfs, std::move(motion)), source_(project.source) {}

  MethodFindings findings(const analysis::PathContributions& whole) const override {
    MethodFindings found = ByInverse::findings(whole);
    found.disagreement = analysis::blocked_forces(frfs_.matrix, motion_, roles_, source_, rule_,
                                                  frfs_.coherent.is_used)
                             .disagreement;
    if (!std::isfinite(found.disagreement)) {
      found.faults.push_back(
          {analysis::TpaFaultKind::halves_disagree, "blocked forces",
           fmt::format("{} indicators are too few for halves that could be held against each "
                       "other: {} at least",
                       roles_.indicators().size(), 2 * (frfs_.matrix.values.columns + 1))});
    }
    if (found.disagreement > most_disagreement) {
      found.faults.push_back(
          {analysis::TpaFaultKind::halves_disagree, "blocked forces",
           fmt::format("every other indicator alone says something else, by {:.0f} % of their "
                       "power: noise, or not all directions of the interface were hit",
                       100 * found.disagreement)});
    }
    return found;
  }

 private:
  std::vector<std::string> source_;
};

void read_by_blocked_forces(hal::ConfigReader& json, TpaProject& project) {
  need_indicators(json, project);
  project.source = json.texts("source");
  for (const auto* role : {&project.indicators, &project.targets, &project.validation}) {
    for (const DegreeOfFreedom& place : *role) {
      if (std::ranges::find(project.source, place.point) == project.source.end()) continue;
      json.fault("source", analysis::name_of(place) +
                               " is a sensor: blocked forces are found from outside the source");
    }
  }
}

MadeTpaMethod make_by_blocked_forces(const TpaProject& project, const TpaFrfs& frfs,
                                     analysis::OperatingSpectra motion) {
  return std::make_unique<ByBlockedForces>(project, frfs, std::move(motion));
}

}  // namespace

NamedTpaMethod blocked_forces_method() {
  return {"blocked_forces",
          "Blocked forces, which are the source's own whatever carries it, are found line by line "
          "from indicators outside the source, by an inverse of the FRFs from its interface.",
          true, read_by_blocked_forces, make_by_blocked_forces};
}

}  // namespace rvbench::bench
