#include "analysis/tpa/on_board_validation.hpp"

#include <limits>
#include <utility>

#include "hal/types/require.hpp"

namespace rvbench::analysis {

using Eigen::Index;

OnBoardValidation::OnBoardValidation(OperatingSpectra measured, LineMatrices synthesised,
                                     std::vector<bool> is_used)
    : measured_(std::move(measured)),
      synthesised_(std::move(synthesised)),
      is_used_(std::move(is_used)) {
  constexpr Require require{"OnBoardValidation"};
  const LineMatrices& values = measured_.values;
  require(values.rows > 0, "no sensor to validate at");
  require(synthesised_.rows == values.rows && synthesised_.columns == values.columns &&
              synthesised_.lines == values.lines && Index(is_used_.size()) == values.lines,
          "what is synthesised has not the shape of what is measured");
}

double OnBoardValidation::score(const TpaBand& band) const {
  return score_of(band, 0, measured_.values.rows);
}

double OnBoardValidation::score(const TpaBand& band, Index sensor) const {
  return score_of(band, sensor, 1);
}

double OnBoardValidation::score() const {
  return score({measured_.grid.first_Hz, std::numeric_limits<double>::infinity()});
}

double OnBoardValidation::score_of(const TpaBand& band, Index first, Index count) const {
  double unexplained = 0, power = 0;
  for (Index line = 0; line < measured_.values.lines; ++line) {
    if (!is_used_[std::size_t(line)] || !holds(band, measured_.grid, line)) continue;
    const auto measured = measured_.values[line].middleRows(first, count);
    unexplained += (measured - synthesised_[line].middleRows(first, count)).squaredNorm();
    power += measured.squaredNorm();
  }
  return power > 0 ? 1 - unexplained / power : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace rvbench::analysis
