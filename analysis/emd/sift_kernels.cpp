#include "analysis/emd/sift_kernels.hpp"

#include <cstdint>

#include "analysis/kernel.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace rvbench::analysis {
namespace {

// No branch on the direction: that of a noisy signal cannot be predicted.
RVBENCH_INTO_KERNEL std::size_t scan_step(const double* samples, std::ptrdiff_t i, ScanState& state,
                                          double* at, double* value) {
  const double step = samples[i + 1] - samples[i];
  if (step == 0) return 0;
  const bool is_rising = step > 0;
  at[0] = 0.5 * static_cast<double>(state.plateau_from + i);
  value[0] = samples[i];
  const bool turns = is_rising != state.is_rising;
  state.is_rising = is_rising;
  state.plateau_from = i + 1;
  return static_cast<std::size_t>(turns);
}

RVBENCH_INTO_KERNEL std::size_t scan_steps(const double* samples, std::ptrdiff_t last,
                                           ScanState& state, double* at, double* value) {
  std::size_t count = 0;
  for (; state.next < last; ++state.next) {
    count += scan_step(samples, state.next, state, at + count, value + count);
  }
  return count;
}

RVBENCH_INTO_KERNEL void mean_cubics_of(const double* at, const double* value,
                                        const double* curvature, const double* inverse_width,
                                        int count, double base, Cubics& mean) {
  // Of each envelope about its own knot: number k of these belongs to knot k - 1.
  double v[Cubics::most + 1], s[Cubics::most + 1], c[Cubics::most + 1], t[Cubics::most + 1];
  for (int k = 0; k <= count; ++k) {
    const double* x = at + k - 1;
    const double* y = value + k - 1;
    const double* m = curvature + k - 1;
    const double inverse = inverse_width[k - 1];
    v[k] = y[0];
    s[k] = (y[2] - y[0]) * inverse - (x[2] - x[0]) * (2 * m[0] + m[2]) * (1. / 6);
    c[k] = 0.5 * m[0];
    t[k] = (m[2] - m[0]) * inverse * (1. / 6);
  }
  for (int k = 0; k < count; ++k) {
    const double d = at[k] - at[k - 1];  // the other envelope's cubic is moved by as much
    const double value_there = v[k] + d * (s[k] + d * (c[k] + d * t[k]));
    const double slope_there = s[k] + d * (2 * c[k] + 3 * d * t[k]);
    const double curve_there = c[k] + 3 * d * t[k];
    mean.value[k] = 0.5 * (v[k + 1] + value_there);
    mean.slope[k] = 0.5 * (s[k + 1] + slope_there);
    mean.curve[k] = 0.5 * (c[k + 1] + curve_there);
    mean.twist[k] = 0.5 * (t[k + 1] + t[k]);
    // The first sample at or after the next knot, which is on a sample or half-way between two.
    mean.end[k] = (static_cast<int>(2 * (at[k + 1] - base)) + 1) >> 1;
  }
}

std::size_t portable_scan(const double* samples, std::ptrdiff_t last, ScanState& state, double* at,
                          double* value) {
  return scan_steps(samples, last, state, at, value);
}

void portable_mean_cubics(const double* at, const double* value, const double* curvature,
                          const double* inverse_width, int count, double base, Cubics& mean) {
  mean_cubics_of(at, value, curvature, inverse_width, count, base, mean);
}

void portable_subtract(double* from_base, double base, const double* at, const Cubics& mean,
                       int count) {
  int i = 0;
  for (int k = 0; k < count; ++k) {
    double u = base + i - at[k];
    for (; i < mean.end[k]; ++i, u += 1) {
      from_base[i] -= mean.value[k] + u * (mean.slope[k] + u * (mean.curve[k] + u * mean.twist[k]));
    }
  }
}

#if defined(__x86_64__)

#define RVBENCH_AVX2 [[gnu::target("avx2")]]

// Bits of four comparisons each.
RVBENCH_AVX2 unsigned greater(const double* a, const double* b) {
  const __m256d is_greater = _mm256_cmp_pd(_mm256_loadu_pd(a), _mm256_loadu_pd(b), _CMP_GT_OQ);
  return static_cast<unsigned>(_mm256_movemask_pd(is_greater));
}

// Moves the lanes whose bit is set to the front.
RVBENCH_AVX2 __m256d packed(__m256d lanes, unsigned bits) {
  // Halves of lanes, 0 to 7 from the right: what a pattern of bits leaves, in order.
  static constexpr std::uint32_t halves[16] = {
      0,    0x10,   0x32,   0x3210,   0x54,   0x5410,   0x5432,   0x543210,
      0x76, 0x7610, 0x7632, 0x763210, 0x7654, 0x765410, 0x765432, 0x76543210};
  const __m256i places = _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28);
  const __m256i order =
      _mm256_srlv_epi32(_mm256_set1_epi32(static_cast<int>(halves[bits])), places);
  return _mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(lanes), order));
}

// No branch on a single turn: those of a noisy signal cannot be predicted.
RVBENCH_AVX2 std::size_t keep_turns(const double* samples, std::ptrdiff_t i, unsigned turns,
                                    double* at, double* value) {
  const __m256d ramp = _mm256_set_pd(3, 2, 1, 0);
  const __m256d places = _mm256_add_pd(_mm256_set1_pd(static_cast<double>(i)), ramp);
  _mm256_storeu_pd(at, packed(places, turns));
  _mm256_storeu_pd(value, packed(_mm256_loadu_pd(samples + i), turns));
  return static_cast<std::size_t>(__builtin_popcount(turns));
}

RVBENCH_AVX2 std::size_t avx2_scan(const double* samples, std::ptrdiff_t last, ScanState& state,
                                   double* at, double* value) {
  std::size_t count = 0;
  ScanState now = state;  // in registers: what is stored meanwhile could be part of `state`
  while (now.next + 8 <= last) {
    const double* s = samples + now.next;
    const unsigned up = greater(s + 1, s) | greater(s + 5, s + 4) << 4U;
    const unsigned down = greater(s, s + 1) | greater(s + 4, s + 5) << 4U;
    const bool has_plateau = (up | down) != 0xFF || now.plateau_from != now.next;
    if (has_plateau) {
      count += scan_steps(samples, now.next + 8, now, at + count, value + count);
      continue;
    }
    const unsigned turns = (up ^ (up << 1U | static_cast<unsigned>(now.is_rising))) & 0xFFU;
    if ((turns & (turns - 1)) != 0) {
      count += keep_turns(samples, now.next, turns & 0xFU, at + count, value + count);
      count += keep_turns(samples, now.next + 4, turns >> 4U, at + count, value + count);
    } else if (turns != 0) {
      const std::ptrdiff_t i = now.next + __builtin_ctz(turns);
      at[count] = static_cast<double>(i);
      value[count] = samples[i];
      ++count;
    }
    now.is_rising = (up & 0x80U) != 0;
    now.next += 8;
    now.plateau_from = now.next;
  }
  count += scan_steps(samples, last, now, at + count, value + count);
  state = now;
  return count;
}

RVBENCH_AVX2 void avx2_mean_cubics(const double* at, const double* value, const double* curvature,
                                   const double* inverse_width, int count, double base,
                                   Cubics& mean) {
  mean_cubics_of(at, value, curvature, inverse_width, count, base, mean);
}

RVBENCH_AVX2 __m256d horner(__m256d u, __m256d value, __m256d slope, __m256d curve, __m256d twist) {
  const __m256d upper = _mm256_add_pd(curve, _mm256_mul_pd(u, twist));
  return _mm256_add_pd(value, _mm256_mul_pd(u, _mm256_add_pd(slope, _mm256_mul_pd(u, upper))));
}

// Cubics of many samples each: four samples of one at a time.
RVBENCH_AVX2 void subtract_long(double* from_base, double base, const double* at,
                                const Cubics& mean, int count) {
  alignas(32) static constexpr long long masks[8] = {-1, -1, -1, -1, 0, 0, 0, 0};
  const __m256d ramp = _mm256_set_pd(3, 2, 1, 0);
  int i = 0;
  for (int k = 0; k < count; ++k) {
    if (mean.end[k] <= i) continue;
    const __m256d value = _mm256_set1_pd(mean.value[k]), slope = _mm256_set1_pd(mean.slope[k]);
    const __m256d curve = _mm256_set1_pd(mean.curve[k]), twist = _mm256_set1_pd(mean.twist[k]);
    __m256d u = _mm256_add_pd(_mm256_set1_pd(base + i - at[k]), ramp);
    for (; i + 4 <= mean.end[k]; i += 4, u = _mm256_add_pd(u, _mm256_set1_pd(4))) {
      const __m256d x = horner(u, value, slope, curve, twist);
      _mm256_storeu_pd(from_base + i, _mm256_sub_pd(_mm256_loadu_pd(from_base + i), x));
    }
    if (i == mean.end[k]) continue;
    const auto* mask_at = reinterpret_cast<const __m256i*>(masks + 4 - (mean.end[k] - i));
    const __m256i mask = _mm256_loadu_si256(mask_at);
    const __m256d x = horner(u, value, slope, curve, twist);
    _mm256_maskstore_pd(from_base + i, mask,
                        _mm256_sub_pd(_mm256_maskload_pd(from_base + i, mask), x));
    i = mean.end[k];
  }
}

constexpr int few = 4;  // samples of a cubic

// The cubic of each sample, written four samples at a time: what is past its end, the next one
// overwrites.
struct SampleCubics {
  static constexpr int most = few * Cubics::most;
  alignas(32) double value[most + 4], slope[most + 4], curve[most + 4], twist[most + 4];
  alignas(32) double from_knot[most + 4];  // of sample 0
};

RVBENCH_AVX2 void spread(const Cubics& mean, double base, const double* at, int count,
                         SampleCubics& of) {
  int from = 0;
  for (int k = 0; k < count; ++k) {
    if (mean.end[k] <= from) continue;
    for (int i = from; i < mean.end[k]; i += 4) {
      _mm256_storeu_pd(of.value + i, _mm256_set1_pd(mean.value[k]));
      _mm256_storeu_pd(of.slope + i, _mm256_set1_pd(mean.slope[k]));
      _mm256_storeu_pd(of.curve + i, _mm256_set1_pd(mean.curve[k]));
      _mm256_storeu_pd(of.twist + i, _mm256_set1_pd(mean.twist[k]));
      _mm256_storeu_pd(of.from_knot + i, _mm256_set1_pd(base - at[k]));
    }
    from = mean.end[k];
  }
}

// Cubics of a few samples each: four samples at a time, whosever they are.
RVBENCH_AVX2 void subtract_short(double* from_base, double base, const double* at,
                                 const Cubics& mean, int count) {
  SampleCubics of;
  spread(mean, base, at, count, of);
  const int samples = mean.end[count - 1];
  __m256d place = _mm256_set_pd(3, 2, 1, 0);
  int i = 0;
  for (; i + 4 <= samples; i += 4, place = _mm256_add_pd(place, _mm256_set1_pd(4))) {
    const __m256d u = _mm256_add_pd(_mm256_load_pd(of.from_knot + i), place);
    const __m256d x = horner(u, _mm256_load_pd(of.value + i), _mm256_load_pd(of.slope + i),
                             _mm256_load_pd(of.curve + i), _mm256_load_pd(of.twist + i));
    _mm256_storeu_pd(from_base + i, _mm256_sub_pd(_mm256_loadu_pd(from_base + i), x));
  }
  for (; i < samples; ++i) {
    const double u = of.from_knot[i] + i;
    from_base[i] -= of.value[i] + u * (of.slope[i] + u * (of.curve[i] + u * of.twist[i]));
  }
}

RVBENCH_AVX2 void avx2_subtract(double* from_base, double base, const double* at,
                                const Cubics& mean, int count) {
  const bool are_short = mean.end[count - 1] <= few * count;
  (are_short ? subtract_short : subtract_long)(from_base, base, at, mean, count);
}

#endif

}  // namespace

const SiftKernels& portable_sift_kernels() {
  static constexpr SiftKernels kernels{portable_scan, portable_mean_cubics, portable_subtract};
  return kernels;
}

const SiftKernels& sift_kernels() {
#if defined(__x86_64__)
  static constexpr SiftKernels kernels{avx2_scan, avx2_mean_cubics, avx2_subtract};
  if (has_avx2()) return kernels;
#endif
  return portable_sift_kernels();
}

}  // namespace rvbench::analysis
