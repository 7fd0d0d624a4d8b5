#include "sim/order_lines.hpp"

#include <complex>
#include <vector>

#include "sim/real_transform.hpp"

namespace rvbench::sim {
namespace {

using Complex = std::complex<double>;

// Where a line of some order stands in the half spectrum of so few samples.
struct Place {
  Eigen::Index index;
  bool is_conjugate;  // turned over, it looks as if it went backward
};

Place place_of(int order, Eigen::Index samples) {
  const Eigen::Index at = order % samples;
  return at <= samples / 2 ? Place{at, false} : Place{samples - at, true};
}

}  // namespace

Signals over_period(const Eigen::MatrixXcd& lines, const PeriodOrders& at) {
  const Eigen::Index samples = at.samples();
  Signals signals(lines.rows(), samples);
  Eigen::VectorXcd spectrum(samples / 2 + 1);
  const double half = 0.5 * static_cast<double>(samples);
  for (Eigen::Index row = 0; row < lines.rows(); ++row) {
    spectrum.setZero();
    spectrum[0] = 2 * half * lines(row, 0).real();
    for (Eigen::Index k = 1; k < lines.cols(); ++k) {
      const Place place = place_of(at.orders()[static_cast<std::size_t>(k - 1)], samples);
      const Complex line = half * lines(row, k);
      spectrum[place.index] = place.is_conjugate ? std::conj(line) : line;
    }
    samples_from_lines(signals.row(row).data(), spectrum.data(), samples);
  }
  return signals;
}

Eigen::MatrixXcd lines_of(const Signals& signals, const PeriodOrders& at) {
  const Eigen::Index samples = at.samples();
  Eigen::MatrixXcd lines(signals.rows(), static_cast<Eigen::Index>(at.orders().size()) + 1);
  Eigen::VectorXcd spectrum(samples / 2 + 1);
  const double scale = 2 / static_cast<double>(samples);
  for (Eigen::Index row = 0; row < lines.rows(); ++row) {
    lines_from_samples(spectrum.data(), signals.row(row).data(), samples);
    lines(row, 0) = 0.5 * scale * spectrum[0];
    for (Eigen::Index k = 1; k < lines.cols(); ++k) {
      const Place place = place_of(at.orders()[static_cast<std::size_t>(k - 1)], samples);
      const Complex line = scale * spectrum[place.index];
      lines(row, k) = place.is_conjugate ? std::conj(line) : line;
    }
  }
  return lines;
}

}  // namespace rvbench::sim
