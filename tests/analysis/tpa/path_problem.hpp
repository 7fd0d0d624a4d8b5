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

  explicit PathProblem(unsigned seed) {
    frfs.responses = places(0, sensors);
    for (Index path = 0; path < paths; ++path) {
      frfs.excitations.push_back({"path " + std::to_string(path + 1), "+X"});
    }
    frfs.response_unit = "m/s²";
    frfs.excitation_unit = "N";
    frfs.first_Hz = 10;
    frfs.step_Hz = 0.5;
    frfs.values = analysis::LineMatrices(sensors, paths, lines);
    frfs.values.values = complex_noise(sensors * paths * lines, 1, seed);
    forces.values = complex_noise(paths * blocks * lines, 1, seed + 100);
    operating = {frfs.responses, "m/s²", {10, 0.5, lines}, {sensors, blocks, lines}};
    respond();
  }

  /// What the sensors show of the forces.
  void respond() {
    for (Index line = 0; line < lines; ++line) {
      operating.values[line] = frfs.values[line] * forces[line];
    }
  }

  void add_sensor_noise(double rms, unsigned seed) {
    operating.values.values += rms * complex_noise(operating.values.values.size(), 1, seed);
  }

  /// Errors of the FRFs after the sensors have answered, of known variance.
  void add_frf_errors(double rms, unsigned seed) {
    frfs.values.values += rms * complex_noise(frfs.values.values.size(), 1, seed);
    frfs.variances = Eigen::MatrixXd::Constant(sensors * paths, lines, rms * rms);
    frfs.noise = frfs.variances;
  }

  analysis::PathContributions solved(const std::string& rule = "none") const {
    return analysis::matrix_inverse_contributions(frfs, operating, roles,
                                                  analysis::find_rule(rule)->rule, {}, 1);
  }

  /// Three directions of a point, as sensors have them.
  static std::vector<DegreeOfFreedom> places(Index first, Index last) {
    std::vector<DegreeOfFreedom> places;
    for (Index i = first; i < last; ++i) {
      places.push_back({std::string(1, char('A' + i / 3)), std::string("+") + "XYZ"[i % 3]});
    }
    return places;
  }
};

}  // namespace rvbench::test
