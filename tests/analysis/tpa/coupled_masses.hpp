#pragma once

#include "analysis/tpa/matrix_inverse.hpp"
#include "hal/types/units.hpp"
#include "tests/analysis/tpa/random_matrices.hpp"

namespace rvbench::test {

/// A body of n coordinates with masses, and springs between them, by chance; one hysteretic loss
/// factor.
struct SpringBody {
  Eigen::MatrixXd stiffness;
  Eigen::VectorXd masses;

  SpringBody(Eigen::Index n, unsigned seed);

  Eigen::MatrixXcd dynamic_stiffness(double omega) const;
};

inline const analysis::LineGrid& coupled_grid() {
  static const analysis::LineGrid grid{20, 0.5, 60};
  return grid;
}

inline double omega_of(Eigen::Index line) {
  return units::two_pi * coupled_grid().frequency_Hz(line);
}

inline std::vector<DegreeOfFreedom> numbered(const std::string& name, Eigen::Index from,
                                             Eigen::Index to) {
  std::vector<DegreeOfFreedom> places;
  for (Eigen::Index i = from; i < to; ++i) places.push_back({name + std::to_string(i), "+X"});
  return places;
}

inline analysis::FrfMatrix frfs_between(std::vector<DegreeOfFreedom> responses,
                                        std::vector<DegreeOfFreedom> excitations) {
  analysis::FrfMatrix frfs;
  const auto rows = Eigen::Index(responses.size()), columns = Eigen::Index(excitations.size());
  frfs.responses = std::move(responses);
  frfs.excitations = std::move(excitations);
  frfs.response_unit = "m/s²";
  frfs.excitation_unit = "N";
  frfs.first_Hz = coupled_grid().first_Hz;
  frfs.step_Hz = coupled_grid().step_Hz;
  frfs.values = analysis::LineMatrices(rows, columns, coupled_grid().lines);
  return frfs;
}

}  // namespace rvbench::test
