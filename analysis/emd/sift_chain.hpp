#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "analysis/emd/sift.hpp"

namespace rvbench::analysis {

/// All sifts of an IMF, one behind the other: while the first looks at new samples, the last is
/// where their envelopes are settled, a block of extrema and about 60 for each sift behind. What
/// they work on stays in the processor's cache, whatever the length of the record.
///
/// Units, errors  of Sift. Source  ours: sift after sift it would be read from memory as often
class SiftChain {
 public:
  explicit SiftChain(int sifts, const SiftRule& rule = {},
                     const SiftKernels& kernels = sift_kernels())
      : sifts_(static_cast<std::size_t>(sifts), Sift(rule, kernels)) {}

  /// Begins with an IMF. @param block  of extrema that are settled at once: large ones cost less,
  ///                                   small ones come sooner, and rounding is all that differs
  void begin(std::size_t block);

  /// As Sift::advance(): the first samples of h become those of the IMF.
  Eigen::Index advance(double* h, Eigen::Index known, bool is_end);

  void rebase(Eigen::Index samples);

  /// Turns a whole signal into its fastest IMF. A signal that does not swing stays as it is.
  /// @param imf  0 is the fastest
  /// @return whether it does
  bool turn_into_imf(Eigen::Ref<Eigen::VectorXd> h, int imf);

  std::size_t sifts() const { return sifts_.size(); }
  std::size_t extrema() const { return sifts_.front().extrema(); }  ///< before any sift
  std::size_t sifted_extrema() const;  ///< of the last sift that found enough of them; or 0

 private:
  std::vector<Sift> sifts_;
};

}  // namespace rvbench::analysis
