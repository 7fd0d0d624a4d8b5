#pragma once

#include <Eigen/Core>
#include <optional>

#include "analysis/emd/emd.hpp"
#include "analysis/emd/sift_chain.hpp"
#include "analysis/emd/sift_passes.hpp"

namespace rvbench::analysis {

/// Takes the fastest IMF out of a whole signal, as the options say.
///
/// Units, source  those of the signal; of emd(), which checks samples and options
class ImfSift {
 public:
  explicit ImfSift(const EmdOptions& options);

  /// Turns a signal into its fastest IMF. One that does not swing stays as it is.
  /// @param imf  as of SiftChain::begin()
  /// @return whether it does
  bool turn_into_imf(Eigen::Ref<Eigen::VectorXd> h, int imf);

  /// Of the last IMF.
  Eigen::Index unreliable_end(Eigen::Index samples) const;

 private:
  SiftChain chain_;
  std::optional<SiftPasses> passes_;  ///< instead, where a rule tells when to stop
};

}  // namespace rvbench::analysis
