#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string_view>
#include <vector>

namespace rvbench::analysis {

/// A pattern that chance seldom makes. It is asked at each point of a chart, of the last `points`
/// there: (value - centre)/σ of each, the newest last.
struct ControlRule {
  std::string_view name;     ///< "nelson_3"
  std::string_view meaning;  ///< "6 in a row rise or fall"
  Eigen::Index points = 1;
  bool (*fires)(const Eigen::Ref<const Eigen::VectorXd>& last) = nullptr;
};

/// The four zone rules. All together call a false alarm once in 92 points that are in control, the
/// first alone once in 370.
/// Source  Western Electric, Statistical Quality Control Handbook (1956); of the rate: Champ &
///         Woodall, Technometrics 29(4), 393-399 (1987)
const std::vector<ControlRule>& western_electric_rules();

/// Nelson's eight tests. Source  Nelson, J. Quality Technology 16(4), 237-239 (1984)
const std::vector<ControlRule>& nelson_rules();

/// Where which rule fired.
struct RuleSignal {
  Eigen::Index at = 0;  ///< the point at which the pattern was complete
  const ControlRule* rule = nullptr;
};

/// Every point at which a rule fires, by point, then in the order of the rules.
/// Shape   N standardised values. Errors  none thrown. Source  of the rules
std::vector<RuleSignal> rule_signals(const Eigen::Ref<const Eigen::VectorXd>& standardised,
                                     const std::vector<ControlRule>& rules);

}  // namespace rvbench::analysis
