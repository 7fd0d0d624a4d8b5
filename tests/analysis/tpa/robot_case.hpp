#pragma once

#include <cmath>
#include <complex>

#include "analysis/tpa/matrix_inverse.hpp"
#include "sim/robot/operation.hpp"
#include "sim/robot/virtual_robot.hpp"
#include "tests/support/signals.hpp"

namespace rvbench::test {

/// How the FRFs of a hammer test are off, without the test: exact FRFs with errors put on them.
struct FrfErrors {
  double scatter = 0.05;  ///< of a hit: each response is off by this factor, the same at all lines
  double noise = 0.01;    ///< of a hit: of the RMS of the response over the lines, white
  int hits = 5;           ///< averaged over

  double scatter_of_mean() const { return scatter / std::sqrt(double(hits)); }
  double noise_of_mean() const { return noise / std::sqrt(double(hits)); }
};

/// Places of the virtual robot's sensors by what they are for.
inline analysis::SensorRoles robot_roles(const sim::VirtualRobot& robot) {
  const auto& all = robot.sensor_places();
  const auto from = [&](Eigen::Index first) { return all.begin() + first; };
  return {{all.begin(), from(sim::VirtualRobot::first_target)},
          {from(sim::VirtualRobot::first_target), from(sim::VirtualRobot::first_validation)},
          {from(sim::VirtualRobot::first_validation), all.end()}};
}

inline analysis::FrfMatrix exact_frfs(const sim::VirtualRobot& robot,
                                      const analysis::LineGrid& grid) {
  return *analysis::assemble_frf_matrix(
              robot.frequency_responses(grid.first_Hz, grid.step_Hz, grid.lines))
              .matrix;
}

/// With errors, and with variances that say how large these are.
inline analysis::FrfMatrix with_errors(analysis::FrfMatrix frfs, const FrfErrors& errors,
                                       unsigned seed) {
  using Index = Eigen::Index;
  const Index pairs = frfs.values.rows * frfs.values.columns, lines = frfs.values.lines;
  Eigen::Map<Eigen::MatrixXcd> values(frfs.values.values.data(), pairs, lines);
  std::mt19937 generator(seed);
  std::normal_distribution<double> gaussian(0, std::sqrt(0.5));
  const auto draw = [&] { return std::complex<double>(gaussian(generator), gaussian(generator)); };
  frfs.variances.resize(pairs, lines);
  for (Index pair = 0; pair < pairs; ++pair) {
    const double noise =
        errors.noise_of_mean() * values.row(pair).norm() / std::sqrt(double(lines));
    const std::complex<double> factor = 1. + errors.scatter_of_mean() * draw();
    for (Index line = 0; line < lines; ++line) {
      frfs.variances(pair, line) =
          std::norm(values(pair, line)) * std::pow(errors.scatter_of_mean(), 2) + noise * noise;
      values(pair, line) = values(pair, line) * factor + noise * draw();
    }
  }
  return frfs;
}

inline analysis::OperatingSpectra spectra_of(const sim::VirtualRobot& robot,
                                             const Recording& recording,
                                             const analysis::LineGrid& grid) {
  return *analysis::operating_spectra(recording, robot.sensor_places(), grid).spectra;
}

}  // namespace rvbench::test
