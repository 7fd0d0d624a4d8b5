#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/tpa/regularisation.hpp"

namespace rvbench::analysis {

/// All that a rule may go by at one line.
struct LineToInvert {
  PicardPowers powers;     ///< of the operating responses
  double noise_floor = 0;  ///< largest singular value of the FRFs' noise; NaN: not known
};

/// How much of a line is to be inverted.
using RegularisationRule = std::function<Regularisation(const LineToInvert&)>;

/// Rules as a project names them.
struct NamedRule {
  std::string_view name;
  bool needs_noise = false;  ///< of the FRFs, to be known
  RegularisationRule rule;
};

/// All of them: none (plain inversion, for comparison), truncation_by_condition (of 100 at most),
/// truncation_by_noise, truncation_by_l_curve, tikhonov_by_gcv, tikhonov_by_l_curve,
/// tikhonov_by_evidence.
/// Units  none. Errors  none thrown. Source  of the rules
const std::vector<NamedRule>& regularisation_rules();

/// The one of that name; nullptr if there is none. Errors  none thrown. Source  definition
const NamedRule* find_rule(std::string_view name);

}  // namespace rvbench::analysis
