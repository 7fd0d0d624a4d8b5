#include "tests/proof/seal/slide_calibration.hpp"

#include <Eigen/QR>

namespace seal {
namespace {

Eigen::VectorXd joined(const std::vector<Eigen::VectorXd>& records) {
  Eigen::Index size = 0;
  for (const Eigen::VectorXd& record : records) size += record.size();
  Eigen::VectorXd all(size);
  Eigen::Index at = 0;
  for (const Eigen::VectorXd& record : records) {
    all.segment(at, record.size()) = record;
    at += record.size();
  }
  return all;
}

}  // namespace

SlideCalibration::SlideCalibration(const std::vector<std::vector<Eigen::VectorXd>>& moved) {
  if (moved.empty()) return;
  Eigen::MatrixXd columns(joined(moved.front()).size(), Eigen::Index(moved.size()));
  for (std::size_t i = 0; i < moved.size(); ++i) {
    columns.col(Eigen::Index(i)) = joined(moved[i]).normalized();
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  moved_ = qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
}

Eigen::VectorXd SlideCalibration::remainder(const std::vector<Eigen::VectorXd>& change) const {
  Eigen::VectorXd all = joined(change);
  if (moved_.cols() > 0) all -= moved_ * (moved_.transpose() * all);
  return all;
}

std::vector<Eigen::VectorXd> SlideCalibration::leaves(
    const std::vector<Eigen::VectorXd>& change) const {
  const Eigen::VectorXd all = remainder(change);
  std::vector<Eigen::VectorXd> left;
  Eigen::Index at = 0;
  for (const Eigen::VectorXd& record : change) {
    left.emplace_back(all.segment(at, record.size()));
    at += record.size();
  }
  return left;
}

double SlideCalibration::times(const std::vector<Eigen::VectorXd>& other,
                               const std::vector<Eigen::VectorXd>& change) const {
  const Eigen::VectorXd own = remainder(other);
  return own.dot(remainder(change)) / own.squaredNorm();
}

}  // namespace seal
