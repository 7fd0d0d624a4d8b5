#pragma once

#include <Eigen/Core>
#include <vector>

namespace rvbench::analysis {

/// How often an IMF is sifted. A fixed count is the only rule whose modes do not depend on the
/// length of the record; others are added as further rules by name.
struct EmdOptions {
  int imfs = 9;    ///< at most; fewer if the residue runs out of extrema
  int sifts = 10;  ///< per IMF (Wu & Huang 2004)
};

struct Emd {
  Eigen::MatrixXd imfs;     ///< N x K, fastest first
  Eigen::VectorXd residue;  ///< x minus the sum of the IMFs

  /// For each IMF, how many samples at either end the end rule makes unreliable.
  std::vector<Eigen::Index> unreliable_ends;
};

/// Empirical mode decomposition.
///
/// Envelopes are cubic splines through maxima and minima; extrema are mirrored at the ends. A
/// plateau counts as one extremum at its middle. Scale, offset and time reversal of x scale,
/// leave and reverse the IMFs (to rounding).
///
/// Shape   N samples → up to options.imfs columns
/// Errors  throws std::invalid_argument: sample not finite, options not positive
/// Source  Huang et al., Proc. R. Soc. A 454, 903-995 (1998); Rilling & Flandrin (2008)
Emd emd(const Eigen::Ref<const Eigen::VectorXd>& x, const EmdOptions& options = {});

}  // namespace rvbench::analysis
