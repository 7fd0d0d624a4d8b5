#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// Values of an even series between its samples: a sinc under a Kaiser window.
///
/// Shape    N samples, place in samples from 0 to N − 1; beyond the ends the last value is held
/// Units    those of the samples; a constant stays what it is
/// Errors   none thrown by at(): x must hold a sample, and the place be finite
/// Limits   what is not finite makes all that lies within half the taps not finite
/// Source   Oppenheim & Schafer, Discrete-Time Signal Processing, ch. 7 (window design)
class SincInterpolator {
 public:
  /// @param taps         samples that a value is made of; even, at least 4
  /// @param kaiser_beta  of the window: 5.65 for 60 dB, 10.06 for 100 dB
  /// @throws std::invalid_argument
  SincInterpolator(Eigen::Index taps, double kaiser_beta);

  double at(const Eigen::Ref<const Eigen::VectorXd>& x, double place) const;

  /// The same of what x holds below `cut` times half its rate: the sinc is as much wider. To be
  /// used where values are taken at fewer places than x has samples.
  /// @param cut  in (0, 1]
  double at(const Eigen::Ref<const Eigen::VectorXd>& x, double place, double cut) const;

 private:
  double shape(double away) const;

  Eigen::Index taps_;
  double kaiser_beta_;
  Eigen::MatrixXd kernel_;   ///< taps by place between two samples; each column sums to 1
  Eigen::VectorXd profile_;  ///< one side of the sinc under its window
};

}  // namespace rvbench::analysis
