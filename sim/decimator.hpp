#pragma once

#include <Eigen/Core>

namespace rvbench::sim {

/// Halves the sample rate of several channels behind a linear-phase half-band filter: the DAQ's
/// own anti-aliasing. Flat to 0.4, below −60 dB above 0.6 of the output rate.
class Decimator {
 public:
  explicit Decimator(Eigen::Index channels);

  /// Takes the next two input scans (channels x 1 each) and gives one output scan.
  void step(const Eigen::Ref<const Eigen::VectorXd>& first,
            const Eigen::Ref<const Eigen::VectorXd>& second, Eigen::Ref<Eigen::VectorXf> out);

 private:
  static constexpr Eigen::Index half = 20;  ///< taps on either side of the middle, even ones 0
  static constexpr Eigen::Index length = 2 * half + 1;

  Eigen::VectorXd taps_;
  Eigen::MatrixXd history_;  ///< channels x 2·length, each scan twice: no wrap inside a sum
  Eigen::Index at_ = 0;
};

}  // namespace rvbench::sim
