#define EIGEN_FFTW_DEFAULT
#include "sim/order_lines.hpp"

#include <complex>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace rvbench::sim {
namespace {

using Complex = std::complex<double>;

// Plans are kept, one set for each thread.
Eigen::FFT<double>& transform() {
  static const bool planner_is_safe = (fftw_make_planner_thread_safe(), true);
  static_cast<void>(planner_is_safe);
  thread_local Eigen::FFT<double> fft(Eigen::default_fft_impl<double>(),
                                      Eigen::FFT<double>::HalfSpectrum);
  return fft;
}

}  // namespace

Signals over_period(const Eigen::MatrixXcd& lines, Eigen::Index samples) {
  Signals signals(lines.rows(), samples);
  Eigen::VectorXcd spectrum(samples / 2 + 1);
  const double half = 0.5 * static_cast<double>(samples);
  for (Eigen::Index row = 0; row < lines.rows(); ++row) {
    spectrum.head(lines.cols()) = half * lines.row(row).transpose();
    spectrum.tail(spectrum.size() - lines.cols()).setZero();
    spectrum[0] = 2 * half * lines(row, 0).real();
    transform().inv(signals.row(row).data(), spectrum.data(), samples);
  }
  return signals;
}

Eigen::MatrixXcd lines_of(const Signals& signals, Eigen::Index orders) {
  Eigen::MatrixXcd lines(signals.rows(), orders + 1);
  const Eigen::Index samples = signals.cols();
  Eigen::VectorXcd spectrum(samples / 2 + 1);
  for (Eigen::Index row = 0; row < signals.rows(); ++row) {
    transform().fwd(spectrum.data(), signals.row(row).data(), samples);
    lines.row(row) = spectrum.head(orders + 1).transpose() * (2 / static_cast<double>(samples));
  }
  lines.col(0) *= 0.5;
  return lines;
}

}  // namespace rvbench::sim
