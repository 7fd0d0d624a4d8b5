#pragma once

#include <Eigen/Core>
#include <optional>

#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// Where the input shaft stood at any time of a record, in turns from the record's first sample.
///
/// Units   turns, s, Hz; channels in rad and rpm
/// Errors  no angle where there is none to be had, as said below; nothing else is thrown
/// Source  Fyfe & Munck, Mech. Syst. Signal Process. 11(2), 187-205 (1997): computed order tracking
class ShaftAngle {
 public:
  /// From the channel input_angle if the record has one, else from its mean speed.
  /// Empty if it has neither, or no rate with it, if the shaft turned back, or never turned.
  static std::optional<ShaftAngle> of(const Recording& record);

  /// From turns at start_s, start_s + step_s and so on, however they were come by.
  /// Empty if there are fewer than two, if one is not finite, or the shaft turned back or never.
  static std::optional<ShaftAngle> of_turns(Eigen::VectorXd turns, double start_s, double step_s);

  /// Of another shaft, that makes so many turns for each turn of this one.
  /// @throws std::invalid_argument if ratio is not above 0
  ShaftAngle geared(double ratio) const;

  bool is_measured() const { return is_measured_; }  ///< else the speed was taken as constant
  double mean_speed_Hz() const;
  double turns_at(double time_s) const;  ///< extrapolates at the ends

  /// When the shaft stands at first_turns, and at each of `count` - 1 even steps beyond; straight
  /// lines between samples of the angle and beyond its ends.
  Eigen::VectorXd times_s(double first_turns, double samples_per_turn, Eigen::Index count) const;

  /// Whole periods of so many input turns that `count` samples from start_s on span.
  double whole_periods(Eigen::Index count, double rate_Hz, double start_s,
                       double period_turns) const;

  /// Samples x, taken at rate_Hz from start_s on, anew at even steps of the shaft angle, over the
  /// largest whole number of periods that fits. Empty if not even one fits.
  ///
  /// N → whole periods, in the unit of x. A windowed sinc: within 0.1 % up to 0.4 of rate_Hz,
  /// images 60 dB down. For even steps no wider than 1/rate_Hz, or of a signal that has nothing
  /// beyond what they hold: it would be folded. over_angle() filters it out, at a price.
  /// @param period_turns    input turns per period
  /// @param least_per_turn  samples per turn, > 0: as many, or up to a few percent more, so that
  ///                        all together have a next_fast_length(), whatever primes the teeth hold
  Eigen::VectorXd resample(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                           double start_s, double period_turns, double least_per_turn) const;

 private:
  /// Counts up from 0, whichever way it turned. False if it turned back, or never turned.
  bool straighten();

  /// @param after  first of turns_ beyond `turns`
  double time_before(Eigen::Index after, double turns) const;

  bool is_measured_ = false;
  double start_s_ = 0;
  double step_s_ = 0;
  Eigen::VectorXd turns_;  ///< at start_s_ + i·step_s_
};

}  // namespace rvbench::analysis
