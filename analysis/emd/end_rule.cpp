#include "analysis/emd/end_rule.hpp"

namespace rvbench::analysis {

const std::vector<const EndRule*>& end_rules() {
  static const std::vector<const EndRule*> rules{&averaged_ends(), &mirrored_ends(), &linear_ends(),
                                                 &slope_ends()};
  return rules;
}

}  // namespace rvbench::analysis
