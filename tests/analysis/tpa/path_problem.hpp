#pragma once

#include <string>

#include "analysis/tpa/matrix_inverse.hpp"
#include "tests/analysis/tpa/random_matrices.hpp"

namespace rvbench::test {

/// Random FRFs and forces: eight indicators at "A", "B" and "C", two targets, two sensors for
/// validation, four paths, 40 lines, 16 blocks.
struct PathProblem {
  using Index = Eigen::Index;
  static constexpr Index paths = 4, indicators = 8, sensors = 12, lines = 40, blocks = 16;

  analysis::FrfMatrix frfs;
  analysis::LineMatrices forces{paths, blocks, lines};
  analysis::OperatingSpectra operating;
  analysis::SensorRoles roles{places(0, 8), places(8, 10), places(10, 12)};

  explicit PathProblem(unsigned seed);

  /// What the sensors show of the forces.
  void respond();

  void add_sensor_noise(double rms, unsigned seed);

  /// Errors of the FRFs after the sensors have answered, of known variance.
  void add_frf_errors(double rms, unsigned seed);

  analysis::PathContributions solved(const std::string& rule = "none") const;

  /// Three directions of a point, as sensors have them.
  static std::vector<DegreeOfFreedom> places(Index first, Index last);
};

}  // namespace rvbench::test
