#define EIGEN_FFTW_DEFAULT
#include "sim/real_transform.hpp"

#include <unsupported/Eigen/FFT>

namespace rvbench::sim {
namespace {

Eigen::FFT<double>& transform() {
  static const bool planner_is_safe = (fftw_make_planner_thread_safe(), true);
  static_cast<void>(planner_is_safe);
  thread_local Eigen::FFT<double> fft(Eigen::default_fft_impl<double>(),
                                      Eigen::FFT<double>::HalfSpectrum);
  return fft;
}

}  // namespace

void lines_from_samples(std::complex<double>* lines, const double* samples, long count) {
  transform().fwd(lines, samples, count);
}

void samples_from_lines(double* samples, const std::complex<double>* lines, long count) {
  transform().inv(samples, lines, count);
}

}  // namespace rvbench::sim
