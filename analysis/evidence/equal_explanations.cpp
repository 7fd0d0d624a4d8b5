#include "analysis/evidence/equal_explanations.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/evidence/lines_by_depth.hpp"

namespace rvbench::analysis {
namespace {

constexpr double carried = 0.9;  // of the signature's power, by its deepest lines

// Orders, as found, of the deepest lines that together carry the evidence.
std::vector<double> carrying_lines(const SignatureScore& score, double nominal_order) {
  double total = 0;
  for (const double depth : score.line_depths) total += depth * depth;
  std::vector<double> orders;
  double sum = 0;
  for (const std::size_t i : lines_by_depth(score)) {
    if (sum >= carried * total) break;
    sum += score.line_depths[i] * score.line_depths[i];
    orders.push_back(score.line_orders[i] * score.order / nominal_order);
  }
  return orders;
}

// Every line that a signature may have, sidebands that other parts claim among them.
std::vector<double> lines_of(const Signature& s, double stretch) {
  std::vector<double> orders;
  for (int h = s.first_harmonic; h <= s.harmonics; ++h) {
    const double main = h * s.order;
    orders.push_back(main * stretch);
    for (const double spacing : s.sidebands) {
      orders.push_back((main - spacing) * stretch);
      orders.push_back((main + spacing) * stretch);
    }
  }
  return orders;
}

bool holds_all(const std::vector<double>& comb, const std::vector<double>& found, double near) {
  return std::all_of(found.begin(), found.end(), [&](double order) {
    return std::any_of(comb.begin(), comb.end(),
                       [&](double line) { return std::abs(line - order) < near; });
  });
}

}  // namespace

std::vector<std::size_t> equal_explanations(const SignatureScore& score,
                                            const Kinematics& kinematics, double resolution) {
  const auto own = static_cast<std::size_t>(score.signature);
  if (score.signature < 0 || own >= kinematics.signatures.size()) {
    throw std::invalid_argument("equal_explanations: no such signature");
  }
  const std::vector<double> found = carrying_lines(score, kinematics.signatures[own].order);
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
