#include "analysis/tpa/linear_phase_filters.hpp"

#include <cmath>
#include <complex>

#include "analysis/fft.hpp"
#include "analysis/tpa/filter_grid.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {

FirMatrix linear_phase_filters(const LineMatrices& s, double first_Hz, double step_Hz,
                               double rate_Hz) {
  const FilterGrid grid = filter_grid("linear_phase_filters", s, first_Hz, step_Hz, rate_Hz);
  const Eigen::Index n = grid.length;
  FirMatrix filters{.outputs = s.rows,
                    .inputs = s.columns,
                    .rate_Hz = rate_Hz,
                    .delay_samples = 0.5 * double(n - 1),
                    .taps = Eigen::MatrixXd(n, s.rows * s.columns)};
  Eigen::VectorXcd lines(n / 2 + 1);
  for (Eigen::Index output = 0; output < s.rows; ++output) {
    for (Eigen::Index input = 0; input < s.columns; ++input) {
      lines.setZero();
      for (Eigen::Index line = 0; line < s.lines; ++line) {
        const Eigen::Index k = grid.first + line;
        const bool is_half_rate = 2 * k == n;
        if (is_half_rate) continue;
        const double omega = units::two_pi * double(k) / double(n);
        lines[k] = std::polar(std::abs(s[line](output, input)), -filters.delay_samples * omega);
      }
      filters.response(output, input) = inverse_fft(lines, n);
    }
  }
  return filters;
}

}  // namespace rvbench::analysis
