#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "analysis/emd/emd.hpp"

namespace rvbench::analysis {

/// EMD of a signal to which noise was added, over and over: what the noise does averages out, and
/// oscillations that come and go no longer change from one IMF to another.
struct EnsembleOptions {
  EmdOptions emd = {};
  int members = 100;
  double noise = 0.2;      ///< standard deviation of the noise, in those of the signal
  std::uint64_t seed = 1;  ///< of the noise: the same one gives the same bits
  unsigned threads = 0;    ///< 0: as many as there are cores; changes no bit of the result
};

/// Ensemble EMD: the mean of the members' IMFs. They do not sum to the signal, and a member may
/// lack the slowest ones, which counts as zero; the residue is what the IMFs leave of the signal.
///
/// Shape   N samples → up to options.emd.imfs columns, as emd(); of unreliable ends the largest of
///         all members that have the IMF
/// Errors  throws std::invalid_argument: sample not finite, options out of range
/// Source  Wu & Huang, Adv. Adapt. Data Anal. 1, 1-41 (2009)
/// Units   those of x
Emd eemd(const Eigen::Ref<const Eigen::VectorXd>& x, const EnsembleOptions& options = {});

/// Complete ensemble EMD with adaptive noise: each IMF is the mean of the first ones of what the
/// IMFs before have left, to each of which that IMF of white noise is added. They sum to the
/// signal.
///
/// Shape, units, errors  as of eemd()
/// Source         Torres et al., ICASSP 2011, 4144-4147
Emd ceemdan(const Eigen::Ref<const Eigen::VectorXd>& x, const EnsembleOptions& options = {});

/// The improved one: averages what an IMF leaves, so that less of the noise stays in the IMFs, and
/// none of them is made of noise alone.
///
/// Shape, units, errors  as of eemd()
/// Source         Colominas, Schlotthauer & Torres, Biomed. Signal Process. Control 14, 19-29
///                (2014)
Emd iceemdan(const Eigen::Ref<const Eigen::VectorXd>& x, const EnsembleOptions& options = {});

}  // namespace rvbench::analysis
