#pragma once

#include <vector>

#include "analysis/tpa/operating_spectra.hpp"

namespace rvbench::analysis {

/// A band of frequencies, both ends included.
struct TpaBand {
  double first_Hz = 0, last_Hz = 0;
};

/// Whether a line lies in the band, to a thousandth of a step. Errors  none thrown
inline bool holds(const TpaBand& band, const LineGrid& grid, Eigen::Index line) {
  const double slack_Hz = 1e-3 * grid.step_Hz;
  return grid.frequency_Hz(line) >= band.first_Hz - slack_Hz &&
         grid.frequency_Hz(line) <= band.last_Hz + slack_Hz;
}

/// What an analysis says that sensors show which it has not seen, beside what they did show.
class OnBoardValidation {
 public:
  /// @param synthesised  sensors x blocks, lines of `measured`
  /// @param is_used      one per line
  /// Errors  throws std::invalid_argument: no sensor, other shapes than the measured one's
  OnBoardValidation(OperatingSpectra measured, LineMatrices synthesised, std::vector<bool> is_used);

  const OperatingSpectra& measured() const { return measured_; }
  const LineMatrices& synthesised() const { return synthesised_; }

  /// Share of the measured power that the synthesis explains, 1 - Σ|y - ŷ|² / Σ|y|², over sensors,
  /// blocks and the lines of the band that are used: 1 if all, 0 if as much as silence would, below
  /// if it is worse. NaN if nothing was measured there.
  /// Errors  none thrown. Source  ISO 20270:2019, on-board validation; the share: definition
  double score(const TpaBand& band) const;

  /// Of one sensor alone.
  double score(const TpaBand& band, Eigen::Index sensor) const;

  /// Over all lines.
  double score() const;

 private:
  double score_of(const TpaBand& band, Eigen::Index first, Eigen::Index count) const;

  OperatingSpectra measured_;
  LineMatrices synthesised_;
  std::vector<bool> is_used_;
};

}  // namespace rvbench::analysis
