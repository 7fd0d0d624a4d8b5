#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "analysis/tpa/contribution_ranking.hpp"
#include "hal/types/units.hpp"
#include "tests/tpa/measured_robot.hpp"

namespace rvbench::test {

/// How far analyses of virtual robots are from what is true there.
struct RobotStudy {
  int cases = 0;  ///< motions x targets
  int leaders_right = 0;
  int contributions = 0;  ///< those above a tenth of the target's RMS
  int within = 0;         ///< of these, within 15 % and 15 degrees
  double worst_rms = 0;   ///< |ratio to the true one - 1|
  double worst_phase_deg = 0;
  double worst_score = 1;  ///< at the sensors for validation, over the band
  double worst_force = 0;  ///< relative error of the forces where the matrix is well conditioned
  double worst_ill_force = 0;  ///< and where it is ill-conditioned

  void add(const RobotStudy& other) {
    cases += other.cases;
    leaders_right += other.leaders_right;
    contributions += other.contributions;
    within += other.within;
    worst_rms = std::max(worst_rms, other.worst_rms);
    worst_phase_deg = std::max(worst_phase_deg, other.worst_phase_deg);
    worst_score = std::min(worst_score, other.worst_score);
    worst_force = std::max(worst_force, other.worst_force);
    worst_ill_force = std::max(worst_ill_force, other.worst_ill_force);
  }
};

/// Condition numbers that lines lie between.
struct Conditions {
  double least = 1, most = 0;
};
inline constexpr Conditions well_conditioned{1, 30}, ill_conditioned{2000, 1e12};

/// Relative error of all forces over the lines of such conditions.
inline double force_error(const analysis::LineMatrices& forces, const analysis::LineMatrices& truth,
                          const Eigen::VectorXd& conditions, const Conditions& among) {
  double error = 0, power = 0;
  for (Eigen::Index line = 0; line < truth.lines; ++line) {
    if (conditions[line] < among.least || conditions[line] > among.most) continue;
    error += (forces[line] - truth[line]).squaredNorm();
    power += truth[line].squaredNorm();
  }
  return std::sqrt(error / power);
}

/// A target's ranking against its true partial responses, paths x blocks.
inline void compare_target(const analysis::PathContributions& found,
                           const analysis::TargetRanking& ranking,
                           const analysis::LineMatrices& truth, Eigen::Index true_leader,
                           RobotStudy& study) {
  const Eigen::Index paths = found.forces.rows;
  Eigen::VectorXd true_power = Eigen::VectorXd::Zero(paths);
  Eigen::VectorXcd common = Eigen::VectorXcd::Zero(paths);
  for (Eigen::Index line = 0; line < truth.lines; ++line) {
    const Eigen::MatrixXcd partial = found.partial(line, ranking.target);
    true_power += truth[line].rowwise().squaredNorm();
    common += partial.cwiseProduct(truth[line].conjugate()).rowwise().sum();
  }
  ++study.cases;
  if (ranking.paths.front().path == true_leader) ++study.leaders_right;
  for (const analysis::BandContribution& path : ranking.paths) {
    const double true_rms =
        std::sqrt(true_power[path.path] * analysis::mean_square_per_power / double(truth.columns));
    if (true_rms < 0.1 * ranking.measured_rms) continue;
    const double rms = std::abs(path.rms / true_rms - 1);
    const double phase_deg = std::abs(std::arg(common[path.path])) * 360 / units::two_pi;
    ++study.contributions;
    if (rms < 0.15 && phase_deg < 15) ++study.within;
    study.worst_rms = std::max(study.worst_rms, rms);
    study.worst_phase_deg = std::max(study.worst_phase_deg, phase_deg);
  }
}

/// All motions and targets of one robot; a study for each rule, of the same data.
inline void study_robot(const sim::VirtualRobot& robot, const analysis::FrfMatrix& frfs,
                        const analysis::LineGrid& grid, const std::vector<std::string>& rules,
                        std::vector<RobotStudy>& studies) {
  const double rate_Hz = robot.options().rate_Hz;
  const analysis::TpaBand band{grid.first_Hz, grid.frequency_Hz(grid.lines - 1)};
  studies.resize(rules.size());
  for (const sim::RobotMotion motion : sim::robot_motions) {
    const sim::Operation operation = sim::operate(robot, motion);
    const analysis::OperatingSpectra spectra = spectra_of(robot, operation.recording, grid);
    const analysis::LineMatrices forces = spectra_of(operation.truth.forces_N, rate_Hz, grid);
    std::vector<analysis::LineMatrices> partial;
    for (Eigen::Index target = 0; target < sim::VirtualRobot::targets; ++target) {
      partial.push_back(
          spectra_of(sim::partial_histories(robot, operation.truth, target), rate_Hz, grid));
    }
    for (std::size_t i = 0; i < rules.size(); ++i) {
      RobotStudy& study = studies[i];
      const auto found = analysis::matrix_inverse_contributions(frfs, spectra, robot_roles(robot),
                                                                analysis::find_rule(rules[i])->rule,
                                                                {}, robot.options().threads);
      study.worst_score = std::min(study.worst_score, found.validation.score());
      study.worst_force = std::max(
          study.worst_force, force_error(found.forces, forces, found.conditions, well_conditioned));
      study.worst_ill_force =
          std::max(study.worst_ill_force,
                   force_error(found.forces, forces, found.conditions, ill_conditioned));
      for (const auto& ranking : analysis::rank_contributions(found, {band})) {
        compare_target(found, ranking, partial[std::size_t(ranking.target)],
                       operation.truth.ranking.leaders[std::size_t(ranking.target)], study);
      }
    }
  }
}

}  // namespace rvbench::test
