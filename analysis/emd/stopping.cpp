#include "analysis/emd/stopping.hpp"

namespace rvbench::analysis {

const std::vector<const StoppingRule*>& stopping_rules() {
  static const std::vector<const StoppingRule*> rules{&s_number_stopping(), &energy_stopping(),
                                                      &rilling_stopping()};
  return rules;
}

}  // namespace rvbench::analysis
