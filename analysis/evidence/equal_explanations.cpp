#include "analysis/evidence/equal_explanations.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/evidence/carrying_lines.hpp"

namespace rvbench::analysis {
std::vector<std::size_t> equal_explanations(const SignatureScore& score,
                                            const Kinematics& kinematics, double resolution) {
  const Signature& own = signature_of(score, kinematics);
  const std::vector<double> found = carrying_lines(score);
  std::vector<std::size_t> equal;
  if (found.empty()) return equal;
  for (std::size_t s = 0; s < kinematics.signatures.size(); ++s) {
    const Signature& other = kinematics.signatures[s];
    if (&other == &own) continue;
    const double first = other.first_harmonic * other.order;
    const double reach = std::max({other.slip, other.tolerance, 0.0});
    const bool explains = std::any_of(found.begin(), found.end(), [&](double order) {
      const double near = same_carrying_line * resolution;
      const double off = std::max(std::abs(order - first) - near, 0.0);
      const double stretch = reach > 0 ? order / first : 1;
      return off <= reach * first &&
             holds_all(comb_lines(other, other.first_harmonic, stretch), found, near);
    });
    if (explains) equal.push_back(s);
  }
  return equal;
}

}  // namespace rvbench::analysis
