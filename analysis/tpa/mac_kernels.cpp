#include "analysis/tpa/mac_kernels.hpp"

#include "analysis/kernel.hpp"

namespace rvbench::analysis {
namespace {

using Lanes [[gnu::vector_size(32), gnu::may_alias]] = double;
using Eigen::Index;

// O outputs by B blocks at once: each filter is loaded for B products, each spectrum for O.
template <int O, int B>
RVBENCH_INTO_KERNEL void accumulate_some(const TileProducts& sizes, const double* h,
                                         const double* x, double* y, Index output, Index block) {
  Lanes re[O][B] = {}, im[O][B] = {};
  for (Index part = 0; part < sizes.parts; ++part) {
    const double* filter[O];
    const double* spectrum[B];
    for (int o = 0; o < O; ++o) {
      filter[o] = h + (part * sizes.outputs + output + o) * sizes.inputs * doubles_per_tile;
    }
    for (int b = 0; b < B; ++b) {
      const Index slot = (sizes.newest + block + b - part + sizes.slots) % sizes.slots;
      spectrum[b] = x + slot * sizes.inputs * doubles_per_tile;
    }
    for (Index i = 0; i < sizes.inputs * doubles_per_tile; i += doubles_per_tile) {
      for (int o = 0; o < O; ++o) {
        const Lanes hr = *reinterpret_cast<const Lanes*>(filter[o] + i);
        const Lanes hi = *reinterpret_cast<const Lanes*>(filter[o] + i + lines_per_tile);
        for (int b = 0; b < B; ++b) {
          const Lanes xr = *reinterpret_cast<const Lanes*>(spectrum[b] + i);
          const Lanes xi = *reinterpret_cast<const Lanes*>(spectrum[b] + i + lines_per_tile);
          re[o][b] += hr * xr;
          re[o][b] -= hi * xi;
          im[o][b] += hr * xi;
          im[o][b] += hi * xr;
        }
      }
    }
  }
  for (int o = 0; o < O; ++o) {
    for (int b = 0; b < B; ++b) {
      double* to = y + ((block + b) * sizes.outputs + output + o) * doubles_per_tile;
      *reinterpret_cast<Lanes*>(to) = re[o][b];
      *reinterpret_cast<Lanes*>(to + lines_per_tile) = im[o][b];
    }
  }
}

template <int O>
RVBENCH_INTO_KERNEL void accumulate_outputs(const TileProducts& sizes, const double* h,
                                            const double* x, double* y, Index output) {
  Index block = 0;
  for (; block + 2 <= sizes.blocks; block += 2) {
    accumulate_some<O, 2>(sizes, h, x, y, output, block);
  }
  if (block < sizes.blocks) accumulate_some<O, 1>(sizes, h, x, y, output, block);
}

RVBENCH_INTO_KERNEL void accumulate_tile(const TileProducts& sizes, const double* h,
                                         const double* x, double* y) {
  Index output = 0;
  for (; output + 2 <= sizes.outputs; output += 2) {
    accumulate_outputs<2>(sizes, h, x, y, output);
  }
  if (output < sizes.outputs) accumulate_outputs<1>(sizes, h, x, y, output);
}

void portable_accumulate(const TileProducts& sizes, const double* h, const double* x, double* y) {
  accumulate_tile(sizes, h, x, y);
}

#if defined(__x86_64__)

[[gnu::target("avx2,fma")]] void avx2_accumulate(const TileProducts& sizes, const double* h,
                                                 const double* x, double* y) {
  accumulate_tile(sizes, h, x, y);
}

#endif

}  // namespace

const MacKernels& portable_mac_kernels() {
  static constexpr MacKernels kernels{portable_accumulate};
  return kernels;
}

const MacKernels& mac_kernels() {
#if defined(__x86_64__)
  static constexpr MacKernels kernels{avx2_accumulate};
  if (has_avx2_and_fma()) return kernels;
#endif
  return portable_mac_kernels();
}

}  // namespace rvbench::analysis
