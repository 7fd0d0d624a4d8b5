#include "analysis/evidence/carrying_lines.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/evidence/lines_by_depth.hpp"
#include "analysis/signature_lines.hpp"

namespace rvbench::analysis {
namespace {

constexpr double carried = 0.9;  // of the signature's squared depth

}  // namespace

const Signature& signature_of(const SignatureScore& score, const Kinematics& kinematics) {
  const auto index = static_cast<std::size_t>(score.signature);
  if (score.signature < 0 || index >= kinematics.signatures.size()) {
    throw std::invalid_argument("signature_of: no such signature");
  }
  return kinematics.signatures[index];
}

std::vector<double> comb_lines(const Signature& signature, int first, double stretch) {
  std::vector<double> orders;
  for (int h = first; h <= signature.harmonics; ++h) {
    for (const double order : harmonic_lines(signature, h, stretch)) orders.push_back(order);
  }
  return orders;
}

std::vector<double> carrying_lines(const SignatureScore& score) {
  double total = 0;
  for (const double depth : score.line_depths) total += depth * depth;
  std::vector<double> orders;
  double sum = 0;
  for (const std::size_t i : lines_by_depth(score)) {
    if (sum >= carried * total) break;
    sum += score.line_depths[i] * score.line_depths[i];
    orders.push_back(score.line_orders[i]);
  }
  return orders;
}

bool holds_all(const std::vector<double>& comb, const std::vector<double>& found, double near) {
  return std::ranges::all_of(found, [&](double order) {
    return std::ranges::any_of(comb, [&](double line) { return std::abs(line - order) < near; });
  });
}

}  // namespace rvbench::analysis
