#include "bench/candidate_probes.hpp"

#include <algorithm>
#include <cmath>

#include "hal/types/parallel_for.hpp"

namespace rvbench::bench {
namespace {

// Standard errors, of all values together: among noise, ten times the usual size leaves a hundred
// times as much.
constexpr double least_mark = 0.03;
// Cosines: no data of this kind would part two laws that are known to look alike; of others, only
// what is the same law here but for rounding stands for both.
constexpr double same_mark = 0.995;
constexpr double one_law = 0.99999;

// Whether one's card says that the other can look alike.
bool are_known_to_look_alike(const analysis::Candidate& a, const analysis::Candidate& b) {
  const auto lists = [](const analysis::Candidate& of, const std::string& name) {
    return std::ranges::find(of.mimics, name) != of.mimics.end();
  };
  return a.name == b.name || lists(a, b.name) || lists(b, a.name);
}

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
      const double alike = are_known_to_look_alike(family.candidates()[i], family.candidates()[k])
                               ? same_mark
                               : one_law;
      return std::abs(mark.dot(other)) > alike * mark.norm() * other.norm();
    });
    if (same == kept.end()) {
      kept.push_back(i);
    } else {
      family.stands_for(*same, i);
    }
  }
}

}  // namespace rvbench::bench
