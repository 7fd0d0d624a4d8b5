#include "analysis/evidence/consequence.hpp"

#include "analysis/evidence/carrying_lines.hpp"

namespace rvbench::analysis {

bool may_follow_from(const SignatureScore& lesser, const SignatureScore& graver,
                     const Kinematics& kinematics, double resolution) {
  const std::vector<double> found = carrying_lines(lesser);
  const Signature& cause = signature_of(graver, kinematics);
  return !found.empty() && holds_all(comb_lines(cause, 0, graver.order / cause.order), found,
                                     same_carrying_line * resolution);
}

}  // namespace rvbench::analysis
