#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace rvbench::analysis {

/// A signal as it is being sifted, before the next sift takes `mean` off it.
struct SiftState {
  const Eigen::VectorXd& h;
  const Eigen::VectorXd& mean;       ///< of the two envelopes
  const Eigen::VectorXd& amplitude;  ///< half the distance between them
};

/// Follows the sifts of one IMF.
class Stopping {
 public:
  virtual ~Stopping() = default;
  /// Whether h is an IMF as it is. Asked before every sift, so once more than there were sifts.
  virtual bool is_imf(const SiftState& state) = 0;
};

/// Decides by what sifting does how often an IMF is sifted. Such rules depend on the length of the
/// record: the IMFs of 10 s and of 60 s of the same signal are not comparable.
///
/// Shape, units  N samples of h, mean and amplitude each, in the signal's unit. Errors  none thrown
struct StoppingRule {
  const char* name;
  std::unique_ptr<Stopping> (*begin)();
};

/// For StoppingRule::begin.
template <typename Kind>
std::unique_ptr<Stopping> begin_stopping() {
  return std::make_unique<Kind>();
}

/// "s_number": numbers of extrema and of zero crossings differ by at most one, and have stayed the
/// same for four sifts.
///
/// Source  Huang et al., Proc. R. Soc. A 459, 2317-2345 (2003), which has several such S
const StoppingRule& s_number_stopping();

/// "energy": the mean of the envelopes is 50 dB below the signal.
///
/// Source  Rato, Ortigueira & Batista, Mech. Syst. Signal Process. 22, 1374-1394 (2008), which
///         takes 40 to 60 dB
const StoppingRule& energy_stopping();

/// "rilling": |mean| / amplitude is below 0.05 for 95 % of the samples and below 0.5 for all.
///
/// Source  Rilling, Flandrin & Gonçalvès, IEEE-EURASIP NSIP-03 (2003)
const StoppingRule& rilling_stopping();

/// All of them.
/// Source  of each
const std::vector<const StoppingRule*>& stopping_rules();

}  // namespace rvbench::analysis
