#include "analysis/order/sinc_kernels.hpp"

#include "analysis/kernel.hpp"

namespace rvbench::analysis {
namespace {

using Lanes [[gnu::vector_size(32), gnu::may_alias, gnu::aligned(8)]] = double;
using Eigen::Index;

constexpr Index lanes = 4;

// Two sums of each kind: a processor adds faster than it has done adding.
RVBENCH_INTO_KERNEL double sum_between(const double* x, const double* below, const double* above,
                                       double weight, Index taps) {
  Lanes low[2] = {}, high[2] = {};
  Index tap = 0;
  for (; tap + 2 * lanes <= taps; tap += 2 * lanes) {
    for (Index half = 0; half < 2; ++half) {
      const Index at = tap + half * lanes;
      const Lanes samples = *reinterpret_cast<const Lanes*>(x + at);
      low[half] += samples * *reinterpret_cast<const Lanes*>(below + at);
      high[half] += samples * *reinterpret_cast<const Lanes*>(above + at);
    }
  }
  const Lanes all_low = low[0] + low[1], all_high = high[0] + high[1];
  double sum_low = (all_low[0] + all_low[1]) + (all_low[2] + all_low[3]);
  double sum_high = (all_high[0] + all_high[1]) + (all_high[2] + all_high[3]);
  for (; tap < taps; ++tap) {
    sum_low += x[tap] * below[tap];
    sum_high += x[tap] * above[tap];
  }
  return (1 - weight) * sum_low + weight * sum_high;
}

double portable_between(const double* x, const double* below, const double* above, double weight,
                        Index taps) {
  return sum_between(x, below, above, weight, taps);
}

#if defined(__x86_64__)

[[gnu::target("avx2,fma")]] double avx2_between(const double* x, const double* below,
                                                const double* above, double weight, Index taps) {
  return sum_between(x, below, above, weight, taps);
}

#endif

}  // namespace

const SincKernels& portable_sinc_kernels() {
  static constexpr SincKernels kernels{portable_between};
  return kernels;
}

const SincKernels& sinc_kernels() {
#if defined(__x86_64__)
  static constexpr SincKernels kernels{avx2_between};
  if (has_avx2_and_fma()) return kernels;
#endif
  return portable_sinc_kernels();
}

}  // namespace rvbench::analysis
