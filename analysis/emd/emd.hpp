#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/emd/sift.hpp"
#include "analysis/emd/stopping.hpp"

namespace rvbench::analysis {

/// How a signal is decomposed. A fixed count of sifts is the only way to stop whose modes do not
/// depend on the length of the record; ten are those of Wu & Huang, Adv. Adapt. Data Anal. 1, 1-41
/// (2009).
struct EmdOptions {
  int imfs = 9;    ///< at most; fewer if the residue runs out of extrema
  int sifts = 10;  ///< per IMF; with a rule, at most
  SiftRule rule = {};
  const StoppingRule* stopping = nullptr;  ///< stops sifting an IMF before that
};

/// @throws std::invalid_argument naming the option that is not positive
void check(const EmdOptions& options);

struct Emd {
  Eigen::MatrixXd imfs;     ///< N x K, fastest first
  Eigen::VectorXd residue;  ///< x minus the sum of the IMFs

  /// For each IMF, how many samples at either end the end rule makes unreliable: further in, the
  /// IMF is within 1 % of its rms of that of a longer record, at 19 of 20 ends. Six of its mean
  /// periods times the fourth root of the sifts; at most N.
  std::vector<Eigen::Index> unreliable_ends;
};

/// Empirical mode decomposition.
///
/// Envelopes are cubic splines through maxima and minima, by default natural ones with one
/// mean swing past either end. A plateau counts as one extremum at its middle; with fewer than
/// three extrema x is all residue. Scale, offset and time reversal of x scale, leave and reverse
/// the IMFs (to rounding).
///
/// Shape   N samples → up to options.imfs columns; any N
/// Threads any number at once; the result does not depend on them
/// Errors  throws std::invalid_argument: sample not finite, options not positive
/// Units   those of x
/// Source  Huang et al., Proc. R. Soc. A 454, 903-995 (1998); Rilling & Flandrin, IEEE Trans.
///         Signal Process. 56(1), 85-95 (2008): which tones it parts
Emd emd(const Eigen::Ref<const Eigen::VectorXd>& x, const EmdOptions& options = {});

}  // namespace rvbench::analysis
