#include "analysis/evidence/consequence.hpp"

#include <stdexcept>

#include "analysis/evidence/carrying_lines.hpp"
#include "analysis/signature_lines.hpp"

namespace rvbench::analysis {
namespace {

const Signature& signature_of(const SignatureScore& score, const Kinematics& kinematics) {
  const auto index = static_cast<std::size_t>(score.signature);
  if (score.signature < 0 || index >= kinematics.signatures.size()) {
    throw std::invalid_argument("may_follow_from: no such signature");
  }
  return kinematics.signatures[index];
}

}  // namespace

bool may_follow_from(const SignatureScore& lesser, const SignatureScore& graver,
                     const Kinematics& kinematics, double resolution) {
  const std::vector<double> found = carrying_lines(lesser, signature_of(lesser, kinematics));
  const Signature& cause = signature_of(graver, kinematics);
  const double stretch = graver.order / cause.order;
  std::vector<double> comb;
  for (int h = 0; h <= cause.harmonics; ++h) {
    for (const double order : harmonic_lines(cause, h)) comb.push_back(order * stretch);
  }
  return !found.empty() && holds_all(comb, found, 0.75 * resolution);
}

}  // namespace rvbench::analysis
