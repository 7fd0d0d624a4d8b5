#include "analysis/tpa/deconvolution_filters.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "analysis/fft.hpp"
#include "analysis/tpa/filter_grid.hpp"
#include "hal/types/require.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;

double rising(double share) {
  return 0.5 - 0.5 * std::cos(0.5 * units::two_pi * std::clamp(share, 0., 1.));
}

// Weight of a frequency: 1 inside the band, 0 outside, half a cosine over its edges.
double band_weight(double frequency_Hz, const FilterDesign& design) {
  if (frequency_Hz < design.from_Hz || frequency_Hz > design.to_Hz) return 0;
  if (design.edge_Hz == 0) return 1;
  const bool fades_in = design.from_Hz > 0;
  const bool fades_out = design.to_Hz < 0.5 * design.rate_Hz;
  const double in = fades_in ? rising((frequency_Hz - design.from_Hz) / design.edge_Hz) : 1;
  const double out = fades_out ? rising((design.to_Hz - frequency_Hz) / design.edge_Hz) : 1;
  return in * out;
}

Eigen::VectorXd tap_weights(const FilterDesign& design) {
  Eigen::VectorXd weights(design.taps);
  const double in = 0.5 * double(design.delay_samples), out = double(design.taps) / 16;
  for (Index i = 0; i < design.taps; ++i) {
    const double start = in > 0 ? rising((double(i) + 1) / in) : 1;
    weights[i] = start * rising(double(design.taps - i) / out);
  }
  return weights;
}

void require_design(const FilterDesign& design, const FilterGrid& grid, double first_Hz,
                    double last_Hz) {
  constexpr Require require{"deconvolution_filters"};
  require(design.taps >= 1 && design.taps <= grid.length,
          std::to_string(design.taps) + " taps of " + std::to_string(grid.length));
  require(design.delay_samples >= 0 && design.delay_samples < design.taps,
          "delay of " + std::to_string(design.delay_samples) + " samples");
  require(design.from_Hz >= first_Hz && design.to_Hz <= last_Hz && design.from_Hz < design.to_Hz,
          "band " + std::to_string(design.from_Hz) + " to " + std::to_string(design.to_Hz) +
              " Hz is not within the lines");
  require(design.edge_Hz >= 0 && 2 * design.edge_Hz <= design.to_Hz - design.from_Hz,
          "edges of " + std::to_string(design.edge_Hz) + " Hz do not fit the band");
}

}  // namespace

DesignedFilters deconvolution_filters(const LineMatrices& s, double first_Hz, double step_Hz,
                                      const FilterDesign& design) {
  const FilterGrid grid =
      filter_grid("deconvolution_filters", s, first_Hz, step_Hz, design.rate_Hz);
  require_design(design, grid, first_Hz, first_Hz + double(s.lines - 1) * step_Hz);
  const Index n = grid.length;
  Eigen::VectorXcd shape(s.lines);
  for (Index line = 0; line < s.lines; ++line) {
    const Index k = grid.first + line;
    const double phase = units::two_pi * double(k * design.delay_samples % n) / double(n);
    shape[line] = std::polar(band_weight(first_Hz + double(line) * step_Hz, design), -phase);
  }
  const Eigen::VectorXd weights = tap_weights(design);
  DesignedFilters designed{{.outputs = s.rows,
                            .inputs = s.columns,
                            .rate_Hz = design.rate_Hz,
                            .delay_samples = double(design.delay_samples),
                            .taps = Eigen::MatrixXd(design.taps, s.rows * s.columns)},
                           Eigen::MatrixXd::Zero(s.rows, s.columns)};
  Eigen::VectorXcd lines(n / 2 + 1);
  for (Index output = 0; output < s.rows; ++output) {
    for (Index input = 0; input < s.columns; ++input) {
      lines.setZero();
      for (Index line = 0; line < s.lines; ++line) {
        lines[grid.first + line] = shape[line] * s[line](output, input);
      }
      // A real signal has real lines at 0 and at half its rate.
      lines[0] = lines[0].real();
      if (n % 2 == 0) lines[n / 2] = lines[n / 2].real();
      const Eigen::VectorXd whole = inverse_fft(lines, n);
      const Eigen::VectorXd kept = whole.head(design.taps).cwiseProduct(weights);
      const double lost = (whole.head(design.taps) - kept).squaredNorm() +
                          whole.tail(n - design.taps).squaredNorm();
      const double energy = whole.squaredNorm();
      designed.cut_share(output, input) = energy > 0 ? lost / energy : 0;
      designed.filters.response(output, input) = kept;
    }
  }
  return designed;
}

Eigen::VectorXd identity_errors(const FirMatrix& filters, const LineMatrices& h, double first_Hz,
                                double step_Hz) {
  constexpr Require require{"identity_errors"};
  const FilterGrid grid = filter_grid("identity_errors", h, first_Hz, step_Hz, filters.rate_Hz);
  require(filters.inputs == h.rows && filters.outputs == h.columns,
          "filters and structure do not fit each other");
  const LineMatrices s = frequency_response(filters, grid.length);
  const Eigen::MatrixXcd one = Eigen::MatrixXcd::Identity(h.columns, h.columns);
  Eigen::VectorXd errors(h.lines);
  for (Index line = 0; line < h.lines; ++line) {
    const Index k = grid.first + line;
    const double omega = units::two_pi * double(k) / double(grid.length);
    const std::complex<double> in_time = std::polar(1., filters.delay_samples * omega);
    errors[line] = (in_time * (s[k] * h[line]) - one).norm() / one.norm();
  }
  return errors;
}

}  // namespace rvbench::analysis
