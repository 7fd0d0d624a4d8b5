#pragma once

#include <vector>

#include "analysis/tpa/matrix_inverse.hpp"
#include "bench/tpa_methods.hpp"

namespace rvbench::bench {

/// Notes a fault where there are fewer indicators than paths.
void need_indicators(hal::ConfigReader& json, const TpaProject& project);

/// Forces by the inverse of FRFs to indicators, with the faults that an inversion shows.
class ByInverse : public TpaMethod {
 public:
  ByInverse(const TpaProject& project, const TpaFrfs& frfs, analysis::OperatingSpectra motion);

  analysis::PathContributions contributions(const analysis::FrfMatrix& frfs,
                                            const std::vector<Eigen::Index>& blocks,
                                            unsigned threads) const override;
  MethodFindings findings(const analysis::PathContributions& whole) const override;

 protected:
  const TpaFrfs& frfs_;
  analysis::OperatingSpectra motion_;
  analysis::SensorRoles roles_;
  analysis::RegularisationRule rule_;
};

}  // namespace rvbench::bench
