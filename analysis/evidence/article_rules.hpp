#pragma once

#include <string>
#include <vector>

#include "analysis/diagnosis.hpp"

namespace rvbench::analysis {

/// One step of the article's reasoning, applied to a diagnosis.
struct ArticleRule {
  std::string question;  ///< "stationary fault?"
  std::string answer;    ///< "yes", "no", "cannot tell", or what it is
  std::string why;       ///< with the figures
};

/// What the article's method alone would name, and what its section 5.1 asks of the first finding:
///
///     alone        the part whose order stands highest in the envelope spectra of IMF 1 to 5
///     stationary   sidebands of the part's rotation around mesh harmonics in most of the points,
///                  and its rotation and multiples themselves as low-frequency lines; a local
///                  fault has both as well, and is none
///     extent       a distributed fault modulates smoothly, most of the squared depth of its
///                  deepest lines is in the first two harmonics; a local one strikes
///     shaft or sun input-shaft misalignment at order 1, profile error of the sun at the rate that
///                  it passes the carrier with, which is the only other one that turns with it
///
/// @param points  that the diagnosis was drawn from
/// @return the first alone without a finding; the second only of a machine with meshes, the last
///         only where shaft or sun leads
/// Units   orders of the input shaft, depths over the mean envelope
/// Errors  none thrown
/// Source  the article, sec. 5.1, after its reference 23; half of the points and half of the
///         squared depth are ours
std::vector<ArticleRule> article_rules(const std::vector<Examination>& points,
                                       const Diagnosis& diagnosis, const Kinematics& kinematics);

}  // namespace rvbench::analysis
