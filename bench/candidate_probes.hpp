#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/plant_family.hpp"
#include "sim/steady_state.hpp"

namespace rvbench::bench {

/// What a candidate of usual size does to a plant that turns steadily.
struct CandidateProbe {
  std::vector<sim::SteadyState> states;  ///< one for each condition asked for, without motions
  std::string fault;                     ///< why there are none
};

/// The plant as it is, with each of the family's candidates in turn.
/// @param solve  a plant under each condition
std::vector<CandidateProbe> probe_candidates(
    const PlantFamily& family,
    const std::function<std::variant<std::vector<sim::SteadyState>, hal::ConfigFault>(
        const sim::PlantSpec&)>& solve);

/// Settles which candidates need not be tried, by their marks on what is compared: those that leave
/// none, and those whose mark is that of an earlier one, which then stands for both: within a
/// cosine of 0.995 if they have one name or one's card lists the other, else only if they agree but
/// for rounding.
/// @param marks  one column for each candidate, in standard errors; zero if it was not probed
void group_candidates(PlantFamily& family, const Eigen::MatrixXd& marks);

}  // namespace rvbench::bench
