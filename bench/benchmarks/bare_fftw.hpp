#pragma once

#include <fftw3.h>

#include <algorithm>
#include <complex>
#include <ctime>
#include <limits>
#include <vector>

namespace rvbench::bench {

/// Of this process, all threads.
inline double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// The least of several tries: what others do on the computer only adds.
/// @param prepare  before each try, outside the clock
template <typename Prepare, typename Work>
double least_cpu_s(int tries, const Prepare& prepare, const Work& work) {
  double least_s = std::numeric_limits<double>::infinity();
  for (int i = 0; i < tries; ++i) {
    prepare();
    const double start_s = cpu_s();
    work();
    least_s = std::min(least_s, cpu_s() - start_s);
  }
  return least_s;
}

template <typename Work>
double least_cpu_s(int tries, const Work& work) {
  return least_cpu_s(
      tries, [] {}, work);
}

/// What FFTW alone takes for real transforms of one length, planned as for a length that comes
/// once.
struct BareFftw {
  double there_s = 0;
  double back_s = 0;

  explicit BareFftw(int samples) {
    std::vector<double> time(std::size_t(samples), 1);
    std::vector<std::complex<double>> lines(std::size_t(samples) / 2 + 1);
    auto* const half = reinterpret_cast<fftw_complex*>(lines.data());
    const fftw_plan there = fftw_plan_dft_r2c_1d(samples, time.data(), half, FFTW_ESTIMATE);
    const fftw_plan back = fftw_plan_dft_c2r_1d(samples, half, time.data(), FFTW_ESTIMATE);
    there_s = least_cpu_s(20, [&] { fftw_execute(there); });
    // It destroys its input, and repeated would grow without bound.
    back_s = least_cpu_s(
        20, [&] { lines.assign(lines.size(), {}); }, [&] { fftw_execute(back); });
    fftw_destroy_plan(there);
    fftw_destroy_plan(back);
  }
};

}  // namespace rvbench::bench
