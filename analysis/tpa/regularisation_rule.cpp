#include "analysis/tpa/regularisation_rule.hpp"

#include <algorithm>

#include "analysis/tpa/tikhonov_by_evidence.hpp"
#include "analysis/tpa/tikhonov_by_gcv.hpp"
#include "analysis/tpa/tikhonov_by_l_curve.hpp"
#include "analysis/tpa/truncation_by_condition.hpp"
#include "analysis/tpa/truncation_by_l_curve.hpp"
#include "analysis/tpa/truncation_by_noise.hpp"

namespace rvbench::analysis {
namespace {

// FRFs of a hammer are known to a hundredth or so: what is smaller is not.
constexpr double usual_condition = 100;

RegularisationRule of_powers(Regularisation (*rule)(const PicardPowers&)) {
  return [rule](const LineToInvert& line) { return rule(line.powers); };
}

}  // namespace

const std::vector<NamedRule>& regularisation_rules() {
  static const std::vector<NamedRule> rules{
      {"none", false,
       [](const LineToInvert& line) {
         return Regularisation{line.powers.singular_values.size(), 0};
       }},
      {"truncation_by_condition", false,
       [](const LineToInvert& line) {
         return truncate_by_condition(line.powers.singular_values, usual_condition);
       }},
      {"truncation_by_noise", true,
       [](const LineToInvert& line) {
         return truncate_by_noise(line.powers.singular_values, line.noise_floor);
       }},
      {"truncation_by_l_curve", false, of_powers(truncate_by_l_curve)},
      {"tikhonov_by_gcv", false, of_powers(tikhonov_by_gcv)},
      {"tikhonov_by_l_curve", false, of_powers(tikhonov_by_l_curve)},
      {"tikhonov_by_evidence", false, of_powers(tikhonov_by_evidence)}};
  return rules;
}

const NamedRule* find_rule(std::string_view name) {
  const auto& rules = regularisation_rules();
  const auto found = std::find_if(rules.begin(), rules.end(),
                                  [&](const NamedRule& rule) { return rule.name == name; });
  return found == rules.end() ? nullptr : &*found;
}

}  // namespace rvbench::analysis
