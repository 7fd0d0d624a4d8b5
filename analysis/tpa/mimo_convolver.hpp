#pragma once

#include <Eigen/Core>
#include <memory>

#include "analysis/tpa/fir_matrix.hpp"
#include "analysis/tpa/mac_kernels.hpp"

namespace rvbench::analysis {

/// How a convolution is cut: what it costs, and how long it waits.
struct ConvolverSettings {
  Eigen::Index partition_samples = 0;  ///< per transform
  Eigen::Index partitions_per_pass = 1;

  /// A result every 128 samples: 26 ms at 4.96 kHz.
  static ConvolverSettings low_latency() { return {128, 1}; }
  /// For what is recorded already: transforms eight times as long as the filters, eight to a pass,
  /// are the cheapest per sample; 2048 taps wait for 23 s of 4.96 kHz.
  static ConvolverSettings throughput(Eigen::Index taps) { return {7 * taps + 1, 8}; }
};

/// Filters that run over streams of samples: each output the sum of all inputs, each through a
/// filter of its own. Uniformly partitioned overlap-save; sums are taken over lines of frequency,
/// so that a block costs one transform per input and one per output, not one per filter.
///
/// Order    push() as the samples come, in blocks of any length, also 0
/// Latency  a sample's output is there at the latest when latency_samples() have come, itself
///          counted; delays of the filters' own come on top
/// Memory   all of it is allocated by the constructor; push() allocates nothing
/// Accuracy 1e-14 of the loudest output, against direct convolution
/// Threads  one at a time per object
/// Source   Oppenheim & Schafer, Discrete-Time Signal Processing (3rd ed., 2010), sec. 8.7:
///          overlap-save; Wefers, Partitioned Convolution Algorithms (2015), ch. 5: uniform
///          partitions with a delay line of spectra
class MimoConvolver {
 public:
  /// @throws std::invalid_argument: no tap, output or input, a tap that is not finite, partition or
  ///         number of partitions below 1
  MimoConvolver(const FirMatrix& filters, const ConvolverSettings& settings,
                const MacKernels& kernels = mac_kernels());
  ~MimoConvolver();
  MimoConvolver(MimoConvolver&&) noexcept;
  MimoConvolver& operator=(MimoConvolver&&) noexcept;

  Eigen::Index latency_samples() const;

  /// How many output samples the next push() of so many samples will give.
  Eigen::Index ready_after(Eigen::Index samples) const;

  /// Output k of the first push goes with input k: the filters' response from rest.
  /// @param in   samples x inputs
  /// @param out  at least ready_after(samples) x outputs; its first rows are written
  /// @return how many rows
  /// @throws std::invalid_argument if a size does not fit. What is not finite stays in the outputs
  ///         for as long as the filters are
  Eigen::Index push(const Eigen::Ref<const Eigen::MatrixXd>& in, Eigen::Ref<Eigen::MatrixXd> out);

 private:
  class Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace rvbench::analysis
