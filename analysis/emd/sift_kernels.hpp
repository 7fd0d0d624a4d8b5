#pragma once

#include <cstddef>

namespace rvbench::analysis {

/// How far a signal has been looked through for extrema.
struct ScanState {
  std::ptrdiff_t next = 0;          ///< the sample whose step to the next one comes next
  std::ptrdiff_t plateau_from = 0;  ///< since there the signal has not moved
  bool is_rising = false;           ///< as it came there
};

/// Cubics u ↦ value + slope·u + curve·u² + twist·u³, side by side.
struct Cubics {
  static constexpr int most = 256;
  double value[most], slope[most], curve[most], twist[most];
  int end[most];  ///< first sample that is not its own, counted from `base`
};

/// The inner loops of a sift, for one kind of processor. All kinds give the same bits: each does
/// the same operations in the same order, and none fuses a product with a sum.
///
/// Units   samples and the signal's own. Errors  none thrown. Source  ours, of MeanEnvelope
struct SiftKernels {
  /// Looks at the steps from state.next to sample `last`; lays extrema at at[0...] and value[0...],
  /// which have room for one per step. @return how many
  std::size_t (*scan)(const double* samples, std::ptrdiff_t last, ScanState& state, double* at,
                      double* value);

  /// The mean of both envelopes between knot j and the next one, for j = 0 ... count - 1, about
  /// knot j. Knots -1 to count + 1 are there, with the curvature of their own envelope and, up to
  /// count - 1, the inverse distance to the next knot of it; count is at most Cubics::most.
  void (*mean_cubics)(const double* at, const double* value, const double* curvature,
                      const double* inverse_width, int count, double base, Cubics& mean);

  /// Subtracts them from samples[base...], each from where the one before ended.
  void (*subtract)(double* from_base, double base, const double* at, const Cubics& mean, int count);
};

/// For any processor.
const SiftKernels& portable_sift_kernels();
/// For this one.
const SiftKernels& sift_kernels();

}  // namespace rvbench::analysis
