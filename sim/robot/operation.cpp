#include "sim/robot/operation.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "hal/types/parallel_for.hpp"
#include "hal/types/require.hpp"
#include "sim/robot/steady_response.hpp"
#include "sim/robot/white_noise.hpp"

namespace rvbench::sim {
namespace {

using Index = Eigen::Index;
constexpr Index paths = VirtualRobot::paths;
constexpr Index targets = VirtualRobot::targets;

// Accelerance from each path to one target: lines x paths.
Eigen::MatrixXcd to_target(const VirtualRobot& robot, const PeriodGrid& grid, Index first,
                           Index count, Index target) {
  const auto at_target = robot.at_sensors().row(VirtualRobot::first_target + target);
  return pair_accelerance(robot.modes(), grid, first, count,
                          robot.at_paths() * at_target.asDiagonal());
}

// How much power at a target a unit of a path's power gives, at each line of the analysed band.
struct BandGain {
  Index first = 0;
  std::array<Eigen::MatrixXd, targets> power;  // lines x paths

  Eigen::MatrixXd rms(const Eigen::MatrixXcd& spectrum_N) const {
    const Eigen::MatrixXd power_N2 = spectrum_N.middleRows(first, power[0].rows()).cwiseAbs2() / 2;
    Eigen::MatrixXd rms_m_s2(paths, targets);
    for (Index target = 0; target < targets; ++target) {
      rms_m_s2.col(target) = power[static_cast<std::size_t>(target)]
                                 .cwiseProduct(power_N2)
                                 .colwise()
                                 .sum()
                                 .cwiseSqrt()
                                 .transpose();
    }
    return rms_m_s2;
  }
};

BandGain band_gain(const VirtualRobot& robot, const OperationTruth& truth) {
  BandGain gain{truth.grid.nearest(truth.band_first_Hz), {}};
  const Index count = truth.grid.nearest(truth.band_last_Hz) + 1 - gain.first;
  const auto one = [&](std::size_t target) {
    gain.power[target] =
        to_target(robot, truth.grid, gain.first, count, static_cast<Index>(target)).cwiseAbs2();
  };
  parallel_for(targets, one, robot.options().threads);
  return gain;
}

void add_lines(Eigen::MatrixXcd& spectrum_N, const ForceShape::Lines& lines) {
  for (const auto& [at, forces_N] : lines) spectrum_N.row(at) += forces_N.transpose();
}

PathRanking draw_ranking(RobotMotion motion, Draw& draw) {
  PathRanking ranking{card_of(motion).leaders, {}};
  for (double& margin : ranking.margins) margin = draw.uniform(0.1, 0.3);
  return ranking;
}

// Forces at ranked strengths into the truth; the lines that they have, sound and faulty.
ForceShape solve_forces(const VirtualRobot& robot, RobotMotion motion, const BandGain& gain,
                        Draw& draw, OperationTruth& truth) {
  const Eigen::MatrixXcd broadband = draw_broadband(truth.grid, draw);
  constexpr int most_draws = 60;
  for (int i = 0; i < most_draws; ++i) {
    ForceShape shape = draw_force_lines(motion, truth.grid, draw);
    truth.spectrum_N = broadband;
    add_lines(truth.spectrum_N, shape.sound);
    add_lines(truth.spectrum_N, shape.fault);
    const Eigen::MatrixXd rms = gain.rms(truth.spectrum_N);
    auto strengths = ranked_strengths(rms, truth.ranking, draw);
    if (!strengths) continue;
    const Index leader = truth.ranking.leaders[0];
    *strengths *= card_of(motion).level_m_s2 / ((*strengths)[leader] * rms(leader, 0));
    if (robot.options().joint3_replaced) {
      truth.spectrum_N = broadband;
      add_lines(truth.spectrum_N, shape.sound);
      shape.fault.clear();
    }
    for (Index path = 0; path < paths; ++path) truth.spectrum_N.col(path) *= (*strengths)[path];
    return shape;
  }
  throw std::runtime_error("virtual robot: no forces of seed " +
                           std::to_string(robot.options().seed) + " rank as they should in " +
                           std::string(card_of(motion).name));
}

std::vector<TrueLine> true_lines(const VirtualRobot& robot, const OperationTruth& truth,
                                 const ForceShape& shape) {
  ForceShape::Lines all = shape.sound;
  all.insert(shape.fault.begin(), shape.fault.end());
  std::vector<TrueLine> lines;
  for (const auto& [at, ignored] : all) {
    TrueLine line{
        static_cast<double>(at) * truth.grid.step_Hz, truth.spectrum_N.row(at).transpose(), {}};
    line.partial_m_s2 =
        line.forces_N.asDiagonal() * robot.accelerance(line.frequency_Hz)
                                         .middleRows(VirtualRobot::first_target, targets)
                                         .transpose();
    lines.push_back(std::move(line));
  }
  return lines;
}

Index record_samples(const RobotOptions& options) {
  return static_cast<Index>(std::lround(options.record_s * options.rate_Hz));
}

Recording record(const VirtualRobot& robot, RobotMotion motion, const OperationTruth& truth,
                 Draw draw) {
  const RobotOptions& options = robot.options();
  const Eigen::MatrixXcd lines = steady_response(robot.modes(), truth.grid, truth.spectrum_N,
                                                 robot.at_paths(), robot.at_sensors());
  Eigen::MatrixXd samples = samples_of(truth.grid, lines, record_samples(options), options.threads);
  std::vector<std::uint64_t> seeds(VirtualRobot::sensors);
  for (auto& seed : seeds) seed = draw.seed();
  Recording recording;
  recording.source = "virtual robot, " + std::string(card_of(motion).name);
  recording.status = "ok";
  recording.channels.resize(VirtualRobot::sensors);
  const auto one = [&](std::size_t i) {
    auto x = samples.col(static_cast<Index>(i));
    const double rms = std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
    add_white_noise(x, options.sensor_noise * rms, seeds[i]);
    const DegreeOfFreedom& place = robot.sensor_places()[i];
    recording.channels[i] = {{place.point, "m/s²", place.direction}, options.rate_Hz, 0, x};
  };
  parallel_for(seeds.size(), one, options.threads);
  return recording;
}

}  // namespace

Operation operate(const VirtualRobot& robot, RobotMotion motion) {
  const std::string name(card_of(motion).name);
  Draw draw = draw_for(robot.options(), "forces, " + name);
  OperationTruth truth;
  truth.grid = period_grid(robot.options());
  truth.ranking = draw_ranking(motion, draw);
  const BandGain gain = band_gain(robot, truth);
  const ForceShape shape = solve_forces(robot, motion, gain, draw, truth);
  truth.partial_rms_m_s2 = gain.rms(truth.spectrum_N);
  truth.lines = true_lines(robot, truth, shape);
  truth.forces_N = samples_of(truth.grid, truth.spectrum_N, record_samples(robot.options()),
                              robot.options().threads);
  Recording recording = record(robot, motion, truth, draw_for(robot.options(), "sensors, " + name));
  return {std::move(recording), std::move(truth)};
}

Eigen::MatrixXd partial_histories(const VirtualRobot& robot, const OperationTruth& truth,
                                  Eigen::Index target) {
  constexpr Require require{"partial_histories"};
  require(target >= 0 && target < targets, "target must be 0 to 2");
  const Eigen::MatrixXcd lines =
      to_target(robot, truth.grid, 0, truth.grid.lines, target).cwiseProduct(truth.spectrum_N);
  return samples_of(truth.grid, lines, truth.forces_N.rows(), robot.options().threads);
}

}  // namespace rvbench::sim
