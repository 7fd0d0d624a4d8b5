#include "analysis/evidence/equal_explanations.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/evidence/carrying_lines.hpp"
#include "analysis/signature_lines.hpp"

namespace rvbench::analysis {
namespace {

// Every line that a signature may have, sidebands that other parts claim among them.
std::vector<double> lines_of(const Signature& s, double stretch) {
  std::vector<double> orders;
  for (int h = s.first_harmonic; h <= s.harmonics; ++h) {
    for (const double order : harmonic_lines(s, h)) orders.push_back(order * stretch);
  }
  return orders;
}

}  // namespace

std::vector<std::size_t> equal_explanations(const SignatureScore& score,
                                            const Kinematics& kinematics, double resolution) {
  const auto own = static_cast<std::size_t>(score.signature);
  if (score.signature < 0 || own >= kinematics.signatures.size()) {
    throw std::invalid_argument("equal_explanations: no such signature");
  }
  const std::vector<double> found = carrying_lines(score, kinematics.signatures[own]);
  std::vector<std::size_t> equal;
  if (found.empty()) return equal;
  for (std::size_t s = 0; s < kinematics.signatures.size(); ++s) {
    const Signature& other = kinematics.signatures[s];
    if (s == own) continue;
    const double first = other.first_harmonic * other.order;
    const double reach = std::max({other.slip, other.tolerance, 0.0});
    const bool explains = std::any_of(found.begin(), found.end(), [&](double order) {
      const double near = 0.75 * resolution;
      const double off = std::max(std::abs(order - first) - near, 0.0);
      const double stretch = reach > 0 ? order / first : 1;
      return off <= reach * first && holds_all(lines_of(other, stretch), found, near);
    });
    if (explains) equal.push_back(s);
  }
  return equal;
}

}  // namespace rvbench::analysis
