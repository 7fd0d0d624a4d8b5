#include "analysis/emd/mode_mixing.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/spectrum.hpp"

namespace rvbench::analysis {

double orthogonality_index(const Eigen::Ref<const Eigen::MatrixXd>& imfs) {
  const Eigen::MatrixXd products = imfs.transpose() * imfs;
  const double power = imfs.rowwise().sum().squaredNorm();
  if (power == 0) return 0;
  return (products.cwiseAbs().sum() - products.diagonal().sum()) / power;
}

Eigen::VectorXd spectral_overlap(const Eigen::Ref<const Eigen::MatrixXd>& imfs) {
  Eigen::MatrixXd power(imfs.rows() / 2 + 1, imfs.cols());
  for (Eigen::Index k = 0; k < imfs.cols(); ++k) {
    power.col(k) = amplitude_spectrum(imfs.col(k), 1, Window::hann).amplitude.array().square();
  }
  Eigen::VectorXd overlap(std::max<Eigen::Index>(imfs.cols() - 1, 0));
  for (Eigen::Index k = 0; k < overlap.size(); ++k) {
    const double weaker = std::min(power.col(k).sum(), power.col(k + 1).sum());
    const double shared = power.col(k).cwiseMin(power.col(k + 1)).sum();
    overlap[k] = weaker > 0 ? shared / weaker : std::nan("");
  }
  return overlap;
}

}  // namespace rvbench::analysis
