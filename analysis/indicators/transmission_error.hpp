#pragma once

#include <Eigen/Core>
#include <optional>

namespace rvbench::analysis {

/// Transmission error, peak to peak: the range of how far the output is off where the input and the
/// mean ratio say.
///
///     e = θ_out − θ_in · (θ_out(m turns) − θ_out(0)) / (θ_in(m turns) − θ_in(0))
///
/// over m, the most whole turns of the output that fit: what repeats with them leaves the ratio as
/// it is.
///
/// Shape   N angles of each, taken at the same times
/// Units   both in any unit of angle, unwrapped; output_turn in that of the output → that of the
///         output
/// Limits  noise of the two samples at the ends tilts e by as much as it is; noise widens the
///         range: compare like with like
/// @return empty where the output made no whole turn, or the input did not move over them
/// Errors  throws std::invalid_argument: none or different numbers of samples, one not finite,
///         output_turn not above 0
/// Source  Welbourn, Fundamental knowledge of gear noise, IMechE C117/79 (1979), for the
///         definition; the choice of m is ours
std::optional<double> transmission_error(const Eigen::Ref<const Eigen::VectorXd>& input,
                                         const Eigen::Ref<const Eigen::VectorXd>& output,
                                         double output_turn);

}  // namespace rvbench::analysis
