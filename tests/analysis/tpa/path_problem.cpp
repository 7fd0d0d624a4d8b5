#include "tests/analysis/tpa/path_problem.hpp"

namespace rvbench::test {

PathProblem::PathProblem(unsigned seed) {
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

void PathProblem::respond() {
  for (Index line = 0; line < lines; ++line) {
    operating.values[line] = frfs.values[line] * forces[line];
  }
}

void PathProblem::add_sensor_noise(double rms, unsigned seed) {
  operating.values.values += rms * complex_noise(operating.values.values.size(), 1, seed);
}

void PathProblem::add_frf_errors(double rms, unsigned seed) {
  frfs.values.values += rms * complex_noise(frfs.values.values.size(), 1, seed);
  frfs.variances = Eigen::MatrixXd::Constant(sensors * paths, lines, rms * rms);
  frfs.noise = frfs.variances;
}

analysis::PathContributions PathProblem::solved(const std::string& rule) const {
  return analysis::matrix_inverse_contributions(frfs, operating, roles,
                                                analysis::find_rule(rule)->rule, {}, 1);
}

std::vector<DegreeOfFreedom> PathProblem::places(Index first, Index last) {
  std::vector<DegreeOfFreedom> places;
  for (Index i = first; i < last; ++i) {
    places.push_back({std::string(1, char('A' + i / 3)), std::string("+") + "XYZ"[i % 3]});
  }
  return places;
}

}  // namespace rvbench::test
