#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "analysis/tpa/contribution_ranking.hpp"
#include "hal/types/units.hpp"
#include "tests/analysis/tpa/robot_case.hpp"

namespace rvbench::test {

/// How far an analysis of the virtual robot is from what is true there.
struct RobotStudy {
  int cases = 0;
  int leaders_right = 0;
  int contributions = 0;  ///< those above a tenth of their target's largest
  int within = 0;         ///< of these, within 15 % and 15 degrees
  double worst_rms = 0;   ///< |ratio to the true one - 1|
  double worst_phase_deg = 0;
  double worst_score = 1;  ///< at the sensors for validation, over the band
  double worst_force = 0;  ///< relative error of the forces where the matrix is well conditioned
};

/// Hann spectra of histories, samples x channels.
inline analysis::LineMatrices spectra_of(const Eigen::MatrixXd& histories, double rate_Hz,
                                         const analysis::LineGrid& grid) {
  Recording recording;
  std::vector<DegreeOfFreedom> places;
  for (Eigen::Index i = 0; i < histories.cols(); ++i) {
    places.push_back({std::to_string(i), "+X"});
    recording.channels.push_back({{std::to_string(i), "", "+X"}, rate_Hz, 0, histories.col(i)});
  }
  return (*analysis::operating_spectra(recording, places, grid).spectra).values;
}

/// Error of the forces over the lines of at most that condition, all paths and blocks together.
inline double force_error(const analysis::PathContributions& found,
                          const analysis::LineMatrices& truth, double most_condition) {
  double error = 0, power = 0;
  for (Eigen::Index line = 0; line < truth.lines; ++line) {
    if (found.conditions[line] > most_condition) continue;
    error += (found.forces[line] - truth[line]).squaredNorm();
    power += truth[line].squaredNorm();
  }
  return power > 0 ? std::sqrt(error / power) : 0;
}

inline void compare_target(const analysis::PathContributions& found,
                           const analysis::LineMatrices& truth, Eigen::Index target,
                           RobotStudy& study) {
  const Eigen::Index paths = found.forces.rows;
  Eigen::VectorXd power = Eigen::VectorXd::Zero(paths), true_power = power;
  Eigen::VectorXcd common = Eigen::VectorXcd::Zero(paths);
  for (Eigen::Index line = 0; line < truth.lines; ++line) {
    const Eigen::MatrixXcd partial = found.partial(line, target);
    power += partial.rowwise().squaredNorm();
    true_power += truth[line].rowwise().squaredNorm();
    common += partial.cwiseProduct(truth[line].conjugate()).rowwise().sum();
  }
  Eigen::Index leader = 0, true_leader = 0;
  power.maxCoeff(&leader);
  true_power.maxCoeff(&true_leader);
  ++study.cases;
  if (leader == true_leader) ++study.leaders_right;
  for (Eigen::Index path = 0; path < paths; ++path) {
    if (true_power[path] < 0.01 * true_power[true_leader]) continue;
    const double rms = std::abs(std::sqrt(power[path] / true_power[path]) - 1);
    const double phase_deg = std::abs(std::arg(common[path])) * 360 / units::two_pi;
    ++study.contributions;
    if (rms < 0.15 && phase_deg < 15) ++study.within;
    study.worst_rms = std::max(study.worst_rms, rms);
    study.worst_phase_deg = std::max(study.worst_phase_deg, phase_deg);
  }
}

/// All motions and targets of one robot.
inline void study_robot(const sim::RobotOptions& options, const FrfErrors& errors,
                        const std::string& rule, const analysis::LineGrid& grid,
                        RobotStudy& study) {
  const sim::VirtualRobot robot(options);
  const analysis::FrfMatrix frfs =
      with_errors(exact_frfs(robot, grid), errors, unsigned(options.seed));
  for (const sim::RobotMotion motion : sim::robot_motions) {
    const sim::Operation operation = sim::operate(robot, motion);
    const auto found = analysis::matrix_inverse_contributions(
        frfs, spectra_of(robot, operation.recording, grid), robot_roles(robot),
        analysis::find_rule(rule)->rule, {}, options.threads);
    study.worst_score = std::min(study.worst_score, found.validation.score());
    study.worst_force = std::max(
        study.worst_force,
        force_error(found, spectra_of(operation.truth.forces_N, options.rate_Hz, grid), 30));
    for (Eigen::Index target = 0; target < sim::VirtualRobot::targets; ++target) {
      compare_target(
          found,
          spectra_of(sim::partial_histories(robot, operation.truth, target), options.rate_Hz, grid),
          target, study);
    }
  }
}

}  // namespace rvbench::test
