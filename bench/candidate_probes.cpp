#include "bench/candidate_probes.hpp"

#include <algorithm>
#include <cmath>

#include "hal/types/parallel_for.hpp"

namespace rvbench::bench {
namespace {

// Standard errors, of all values together: among noise, ten times the usual size leaves a hundred
// times as much.
constexpr double least_mark = 0.03;
constexpr double same_mark = 0.995;  // cosine: no data of this kind would part them

}  // namespace

std::vector<CandidateProbe> probe_candidates(
    const PlantFamily& family,
    const std::function<std::variant<std::vector<sim::SteadyState>, hal::ConfigFault>(
        const sim::PlantSpec&)>& solve) {
  std::vector<CandidateProbe> probes(family.candidates().size());
  parallel_for(probes.size(), [&](std::size_t i) {
    auto states = solve(family.with_usual(i));
    if (const auto* fault = std::get_if<hal::ConfigFault>(&states)) {
      probes[i].fault = fault->message;
      return;
    }
    probes[i].states = std::get<0>(std::move(states));
    for (sim::SteadyState& state : probes[i].states) state.motion.resize(0, 0);
  });
  return probes;
}

void group_candidates(PlantFamily& family, const Eigen::MatrixXd& marks) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < family.candidates().size(); ++i) {
    if (!family.candidates()[i].not_exercised.empty()) continue;
    const auto mark = marks.col(static_cast<Eigen::Index>(i));
    if (mark.norm() < least_mark) {
      family.cannot_show(i, "changes nothing that these recordings show");
      continue;
    }
    const auto same = std::ranges::find_if(kept, [&](std::size_t k) {
      const auto other = marks.col(static_cast<Eigen::Index>(k));
      return std::abs(mark.dot(other)) > same_mark * mark.norm() * other.norm();
    });
    if (same == kept.end()) {
      kept.push_back(i);
    } else {
      family.stands_for(*same, i);
    }
  }
}

}  // namespace rvbench::bench
