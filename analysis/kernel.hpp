#pragma once

// What kernels have in common: inner loops that are compiled once per kind of processor, each kind
// into functions of its own.

/// Marks a body that each kind compiles into its own functions. It calls nothing that could be
/// shared with code for another kind.
#define RVBENCH_INTO_KERNEL [[gnu::always_inline]] inline

namespace rvbench::analysis {

#if defined(__x86_64__)

/// Whether this processor can run what is compiled for "avx2", or for "avx2,fma".
/// Errors  none thrown. Source  GCC manual, x86 built-in functions: __builtin_cpu_supports
inline bool has_avx2() {
  static const bool has = __builtin_cpu_supports("avx2") != 0;
  return has;
}
inline bool has_avx2_and_fma() {
  static const bool has = has_avx2() && __builtin_cpu_supports("fma") != 0;
  return has;
}

#endif

}  // namespace rvbench::analysis
