#pragma once

#include <fftw3.h>

#include <algorithm>
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
template <typename Work>
double least_cpu_s(int tries, const Work& work) {
  double least_s = std::numeric_limits<double>::infinity();
  for (int i = 0; i < tries; ++i) {
    const double start_s = cpu_s();
    work();
    least_s = std::min(least_s, cpu_s() - start_s);
  }
  return least_s;
}

/// What FFTW alone takes for real transforms of one length, planned as for a length that comes
/// once.
struct BareFftw {
  double there_s = 0;
  double back_s = 0;

  explicit BareFftw(int samples) {
    std::vector<double> time(std::size_t(samples), 1);
    std::vector<fftw_complex> lines(std::size_t(samples) / 2 + 1);
    const fftw_plan there = fftw_plan_dft_r2c_1d(samples, time.data(), lines.data(), FFTW_ESTIMATE);
    const fftw_plan back = fftw_plan_dft_c2r_1d(samples, lines.data(), time.data(), FFTW_ESTIMATE);
    std::fill(time.begin(), time.end(), 1);
    there_s = least_cpu_s(20, [&] { fftw_execute(there); });
    back_s = least_cpu_s(20, [&] {  // which destroys its input, and may not grow without bound
      std::fill(&lines[0][0], &lines[0][0] + 2 * lines.size(), 1);
      fftw_execute(back);
    });
    fftw_destroy_plan(there);
    fftw_destroy_plan(back);
  }
};

}  // namespace rvbench::bench
