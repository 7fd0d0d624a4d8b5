#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "analysis/emd/sift.hpp"
#include "analysis/emd/stopping.hpp"

namespace rvbench::analysis {

/// Sifts a whole signal pass by pass, until a rule that looks at all of it says that it is an IMF.
///
/// Units, errors, source  of Sift; of the rule
class SiftPasses {
 public:
  /// @param most_sifts  after so many it counts as one
  SiftPasses(const StoppingRule& stopping, const SiftRule& rule, int most_sifts)
      : stopping_(&stopping), rule_(rule), most_sifts_(most_sifts) {}

  /// As SiftChain::turn_into_imf().
  bool turn_into_imf(Eigen::Ref<Eigen::VectorXd> h);

  int sifts() const { return sifts_; }              ///< that the last IMF took
  std::size_t extrema() const { return extrema_; }  ///< found by the last sift

 private:
  bool draw_envelopes(const Eigen::VectorXd& h);

  const StoppingRule* stopping_;
  SiftRule rule_;
  int most_sifts_;
  int sifts_ = 0;
  std::size_t extrema_ = 0;
  std::size_t found_ = 0;  ///< extrema of the signal as it is
  Knots knots_;
  MeanEnvelope envelope_;
  Eigen::VectorXd mean_, amplitude_;
};

}  // namespace rvbench::analysis
