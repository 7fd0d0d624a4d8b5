#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// Lines of spectra in tiles of four: real parts, then imaginary parts, contiguous.
inline constexpr Eigen::Index lines_per_tile = 4;
inline constexpr Eigen::Index doubles_per_tile = 2 * lines_per_tile;

/// The products of one tile of a partitioned convolution.
struct TileProducts {
  Eigen::Index inputs = 0;
  Eigen::Index outputs = 0;
  Eigen::Index parts = 0;   ///< of the filters
  Eigen::Index blocks = 0;  ///< worked on at once
  Eigen::Index slots = 0;   ///< of the ring of spectra, >= parts + blocks - 1
  Eigen::Index newest = 0;  ///< slot of block 0; block b has the one b later, around the ring
};

/// Multiplies and adds: the inner loop of a convolution, for one kind of processor. The kinds agree
/// to rounding: one fuses products with sums. Filters come from memory once for all blocks.
///
///     y[block][output] = Σ over parts p, inputs i of  h[p][output][i] · x[slot of block - p][i]
///
/// each of them one tile.
struct MacKernels {
  void (*accumulate)(const TileProducts& sizes, const double* h, const double* x, double* y);
};

/// For any processor.
const MacKernels& portable_mac_kernels();
/// For this one.
const MacKernels& mac_kernels();

}  // namespace rvbench::analysis
