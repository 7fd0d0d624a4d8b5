#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "analysis/frf/indicator_peaks.hpp"
#include "analysis/frf/pole_fit.hpp"
#include "hal/types/frequency_response.hpp"

namespace rvbench::analysis {

/// The pole of one peak, fitted in the lines from..to together with those of the peaks beside it.
struct PeakFit {
  Eigen::Index from = 0, to = 0;
  int poles = 1;
  Eigen::Index pole = 0;  ///< the peak's own, of fit.poles_rad_s
  PoleFit fit;

  double frequency_Hz() const;  ///< undamped
  double peak_Hz() const;       ///< damped
  double damping_ratio() const;
};

/// Fits responses of the same lines around the peaks of their mode indicator.
///
/// Units   Hz. Errors  none thrown: where no fit settles, or lines are not known, there is none
/// Source  fit_poles()
class PeakFitter {
 public:
  /// @param responses      of one first line, step and number of lines, in any unit
  /// @param least_rise_dB  of a peak, see indicator_peaks()
  PeakFitter(const std::vector<FrequencyResponse>& responses, double least_rise_dB);

  const std::vector<IndicatorPeak>& peaks() const { return peaks_; }
  double step_Hz() const { return step_Hz_; }
  double frequency_Hz(Eigen::Index line) const { return first_Hz_ + double(line) * step_Hz_; }

  /// In one and a half half-power bandwidths to each side, as the fit itself finds them; five lines
  /// at least.
  std::optional<PeakFit> settled_fit(const IndicatorPeak& peak) const;

  /// In so many lines to each side.
  std::optional<PeakFit> fit_at(const IndicatorPeak& peak, Eigen::Index half) const;

  /// That noise improves the fit as much as this pole does: F test.
  double p_value(const PeakFit& found) const;

  /// Share of the responses' power in the band.
  double explained(const PeakFit& found) const;

 private:
  std::optional<PoleFit> fit_band(Eigen::Index from, Eigen::Index to, int poles) const;

  double first_Hz_, step_Hz_;
  Eigen::MatrixXcd values_;       // lines x responses
  Eigen::Index first_known_ = 0;  // of a mobility at 0 Hz nothing is known
  std::vector<IndicatorPeak> peaks_;
};

}  // namespace rvbench::analysis
