#pragma once

#include <Eigen/Core>
#include <optional>

namespace rvbench::analysis {

/// A stretch of samples that are all the same.
struct FrozenSamples {
  Eigen::Index first = 0;
  Eigen::Index count = 0;
  Eigen::Index usual = 0;  ///< as many are the same elsewhere, but for one run in a thousand
};

/// The longest run of identical samples, if it is more than ten times as long as the converter's
/// steps make them: runs of a signal that is slow, coarsely quantised or held are long everywhere,
/// and what a program put in the place of lost samples is not.
///
/// Shape   N samples → one run, the longest; none in fewer than 100 runs
/// Units   samples, whatever they are in. Errors  none thrown. Source  ours
/// Limits  stretches that make up more than one run in a thousand count as usual
std::optional<FrozenSamples> find_frozen_samples(const Eigen::Ref<const Eigen::VectorXd>& x);

}  // namespace rvbench::analysis
