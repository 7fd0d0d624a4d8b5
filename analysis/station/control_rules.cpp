#include "analysis/station/control_rules.hpp"

namespace rvbench::analysis {
namespace {

using Last = Eigen::Ref<const Eigen::VectorXd>;

// The newest and as many before it as it takes lie beyond that many σ, on one side.
bool are_beyond(const Last& z, double sigmas, Eigen::Index of_these) {
  const double newest = z[z.size() - 1];
  if (newest > sigmas) return (z.array() > sigmas).count() >= of_these;
  if (newest < -sigmas) return (z.array() < -sigmas).count() >= of_these;
  return false;
}

bool one_beyond_three(const Last& z) { return are_beyond(z, 3, 1); }
bool two_of_three_beyond_two(const Last& z) { return are_beyond(z, 2, 2); }
bool four_of_five_beyond_one(const Last& z) { return are_beyond(z, 1, 4); }
bool all_on_one_side(const Last& z) { return are_beyond(z, 0, z.size()); }
bool all_within_one(const Last& z) { return (z.array().abs() < 1).all(); }
bool none_within_one(const Last& z) { return (z.array().abs() > 1).all(); }

Eigen::ArrayXd steps_within(const Last& z) { return z.tail(z.size() - 1) - z.head(z.size() - 1); }

bool rise_or_fall(const Last& z) {
  const Eigen::ArrayXd step = steps_within(z);
  return (step > 0).all() || (step < 0).all();
}
bool go_up_and_down(const Last& z) {
  const Eigen::ArrayXd step = steps_within(z);
  return (step.head(step.size() - 1) * step.tail(step.size() - 1) < 0).all();
}

}  // namespace

const std::vector<ControlRule>& western_electric_rules() {
  static const std::vector<ControlRule> rules{
      {"western_electric_1", "beyond 3 sigma", 1, one_beyond_three},
      {"western_electric_2", "2 of 3 beyond 2 sigma on one side", 3, two_of_three_beyond_two},
      {"western_electric_3", "4 of 5 beyond 1 sigma on one side", 5, four_of_five_beyond_one},
      {"western_electric_4", "8 in a row on one side of the centre", 8, all_on_one_side}};
  return rules;
}

const std::vector<ControlRule>& nelson_rules() {
  static const std::vector<ControlRule> rules{
      {"nelson_1", "beyond 3 sigma", 1, one_beyond_three},
      {"nelson_2", "9 in a row on one side of the centre", 9, all_on_one_side},
      {"nelson_3", "6 in a row rise or fall", 6, rise_or_fall},
      {"nelson_4", "14 in a row go up and down in turn", 14, go_up_and_down},
      {"nelson_5", "2 of 3 beyond 2 sigma on one side", 3, two_of_three_beyond_two},
      {"nelson_6", "4 of 5 beyond 1 sigma on one side", 5, four_of_five_beyond_one},
      {"nelson_7", "15 in a row within 1 sigma", 15, all_within_one},
      {"nelson_8", "8 in a row beyond 1 sigma, to either side", 8, none_within_one}};
  return rules;
}

std::vector<RuleSignal> rule_signals(const Eigen::Ref<const Eigen::VectorXd>& standardised,
                                     const std::vector<ControlRule>& rules) {
  std::vector<RuleSignal> signals;
  for (Eigen::Index at = 0; at < standardised.size(); ++at) {
    for (const ControlRule& rule : rules) {
      if (at + 1 < rule.points) continue;
      if (rule.fires(standardised.segment(at + 1 - rule.points, rule.points))) {
        signals.push_back({at, &rule});
      }
    }
  }
  return signals;
}

}  // namespace rvbench::analysis
