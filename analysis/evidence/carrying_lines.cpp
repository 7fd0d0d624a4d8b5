#include "analysis/evidence/carrying_lines.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/evidence/lines_by_depth.hpp"

namespace rvbench::analysis {
namespace {

constexpr double carried = 0.9;  // of the signature's squared depth

}  // namespace

std::vector<double> carrying_lines(const SignatureScore& score, const Signature& signature) {
  double total = 0;
  for (const double depth : score.line_depths) total += depth * depth;
  std::vector<double> orders;
  double sum = 0;
  for (const std::size_t i : lines_by_depth(score)) {
    if (sum >= carried * total) break;
    sum += score.line_depths[i] * score.line_depths[i];
    orders.push_back(score.line_orders[i] * score.order / signature.order);
  }
  return orders;
}

bool holds_all(const std::vector<double>& comb, const std::vector<double>& found, double near) {
  return std::ranges::all_of(found, [&](double order) {
    return std::ranges::any_of(comb, [&](double line) { return std::abs(line - order) < near; });
  });
}

}  // namespace rvbench::analysis
