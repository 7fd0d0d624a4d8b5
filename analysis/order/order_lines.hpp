#pragma once

#include <Eigen/Core>

#include "analysis/shaft_angle.hpp"
#include "analysis/spectrum.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// A signal over whole periods of a gear train: one transform that bands, lines and averages of its
/// gears are all read from. What the gears make lies on its lines.
///
/// Shape   samples even in shaft angle over whole periods; empty if not even one fits
/// Units   orders of the input shaft; samples in the unit of the signal
/// Limits  up to `top_order`, 0.4 of the record's rate; what is above is aliased or damped
/// Source  McFadden, Mech. Syst. Signal Process. 1(1), 83-95 (1987): averaging over the turns of a
///         gear keeps the lines at multiples of its order, and no others
class OrderLines {
 public:
  OrderLines() = default;  ///< empty

  /// Errors  throws std::invalid_argument: a sample is not finite
  OrderLines(const Channel& x, const ShaftAngle& angle, double period_turns);

  /// The highest order that a record of this rate holds.
  static double top_order_of(double rate_Hz, const ShaftAngle& angle);

  bool empty() const { return samples_.size() == 0; }
  Eigen::Index samples() const { return samples_.size(); }
  double turns() const { return turns_; }  ///< of the input shaft, that the samples span
  double top_order() const { return top_order_; }
  double mean_speed_Hz() const { return mean_speed_Hz_; }
  bool angle_is_measured() const { return angle_is_measured_; }

  /// Amplitudes under a Hann window, as amplitude_spectrum() has them; the last line, at half the
  /// rate, is 0.
  const Spectrum& spectrum() const { return spectrum_; }

  /// fft() of the samples about their mean, `turns()` lines an order.
  const Eigen::VectorXcd& lines() const { return lines_; }

  /// What lies from one order up to another, at least eight samples per turn of the highest where
  /// the record has as many. The mean is in no band.
  Eigen::VectorXd between(double from, double to) const;

  /// The average turn of a gear that makes `order` turns per turn of the input shaft, about its
  /// mean and up to top_order(). Empty where it made fewer than four.
  ///
  /// Limits  where the record is no whole number of its turns, the rest is left out, to half a
  ///         sample: a line at a quarter of their rate is then 3 % low, one at a tenth 0.4 %
  Eigen::VectorXd average_turn(double order) const;

  /// fft() of average_turn(), and how many samples that has; none where it is empty.
  struct TurnLines {
    Eigen::VectorXcd lines = {};
    Eigen::Index samples = 0;
  };
  TurnLines turn_lines(double order) const;

 private:
  Eigen::VectorXd samples_;  ///< about their mean
  Eigen::VectorXcd lines_;   ///< fft() of them
  Spectrum spectrum_;        ///< of `lines_`, under a Hann window
  double mean_ = 0;
  double turns_ = 0;
  double top_order_ = 0;
  double mean_speed_Hz_ = 0;
  bool angle_is_measured_ = false;
};

}  // namespace rvbench::analysis
