#pragma once

#include <Eigen/Core>
#include <vector>

namespace seal {

/// What a calibration of a machine that moves along one way can do to its records: its numbers are
/// free, and the same in all of them.
class SlideCalibration {
 public:
  /// @param moved  per number, by how much it changes each record, in any scale
  explicit SlideCalibration(const std::vector<std::vector<Eigen::VectorXd>>& moved);

  /// What it leaves of a change of the records.
  std::vector<Eigen::VectorXd> leaves(const std::vector<Eigen::VectorXd>& change) const;

  /// How many times another change comes nearest to this one, beside what the numbers do.
  double times(const std::vector<Eigen::VectorXd>& other,
               const std::vector<Eigen::VectorXd>& change) const;

 private:
  Eigen::VectorXd remainder(const std::vector<Eigen::VectorXd>& change) const;
  Eigen::MatrixXd moved_;  // columns at right angles, of unit length
};

}  // namespace seal
