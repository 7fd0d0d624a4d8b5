#include "tests/analysis/tpa/coupled_masses.hpp"

namespace rvbench::test {

SpringBody::SpringBody(Eigen::Index n, unsigned seed) {
  const Eigen::MatrixXd links = complex_noise(n, 2 * n, seed).real();
  stiffness = 2e4 * links * links.transpose();
  stiffness.diagonal().array() += 1e4;
  masses = 1 + complex_noise(n, 1, seed + 1).real().array().square();
}

Eigen::MatrixXcd SpringBody::dynamic_stiffness(double omega) const {
  Eigen::MatrixXcd z = stiffness * std::complex<double>(1, 0.05);
  z.diagonal() -= omega * omega * masses.cast<std::complex<double>>();
  return z;
}

}  // namespace rvbench::test
