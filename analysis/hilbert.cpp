#include "analysis/hilbert.hpp"

#include <complex>
#include <stdexcept>
#include <string>
#include <utility>

#include "analysis/fft.hpp"

namespace rvbench::analysis {

Eigen::VectorXd envelope(const Eigen::Ref<const Eigen::VectorXd>& x) {
  const Eigen::Index n = x.size();
  if (n < 4) {
    throw std::invalid_argument("envelope: N = " + std::to_string(n) + ", at least 4");
  }
  if (!x.allFinite()) throw std::invalid_argument("envelope: sample not finite");

  // The Hilbert transform delays every line by a quarter period; lines 0 and N/2 have none.
  Eigen::VectorXcd lines = fft(x) * std::complex<double>(0, -1);
  lines[0] = 0;
  if (n % 2 == 0) lines[n / 2] = 0;
  const Eigen::VectorXd quadrature = inverse_fft(std::move(lines), n);
  return (x.array().square() + quadrature.array().square()).sqrt();
}

}  // namespace rvbench::analysis
