#include "analysis/station/tolerance_factor.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "analysis/station/distributions.hpp"
#include "analysis/station/rising_root.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

constexpr int steps = 400;      // twice as many change no digit that is told
constexpr double nothing = 39;  // e^-39: what is left out at the ends of an integral

struct Node {
  double x = 0;
  double weight = 0;
};

void check(const char* where, std::size_t units, const Coverage& coverage) {
  const Require require{where};
  require(units >= 2, "needs 2 units or more");
  require(coverage.content > 0 && coverage.content < 1, "the content is a share between 0 and 1");
  require(coverage.confidence > 0 && coverage.confidence < 1,
          "the confidence is a share between 0 and 1");
}

// The standard deviation s of a sample, in units of σ: nodes even in ln s, where the trapezoidal
// rule converges at once.
std::vector<Node> deviation_nodes(double freedom) {
  const double width = std::sqrt(nothing / freedom);
  const double from = -(nothing / freedom + width), step = (width - from) / steps;
  std::vector<Node> nodes;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double log_s = from + i * step;
    const double weight = std::exp(freedom * (log_s - std::expm1(2 * log_s) / 2));
    nodes.push_back({std::exp(log_s), weight});
    sum += weight;
  }
  for (Node& node : nodes) node.weight /= sum;
  return nodes;
}

// The mean of a sample as y = |x̄|·√n.
std::vector<Node> mean_nodes() {
  constexpr double far = 9;
  std::vector<Node> nodes;
  for (int i = 0; i <= steps; ++i) {
    const double y = i * far / steps;
    const double density = 2 * std::exp(-y * y / 2) / std::sqrt(2 * std::numbers::pi);
    nodes.push_back({y, (i == 0 ? 0.5 : 1.0) * density * far / steps});
  }
  return nodes;
}

}  // namespace

double one_sided_tolerance_factor(std::size_t units, const Coverage& coverage) {
  check("one_sided_tolerance_factor", units, coverage);
  const double root = std::sqrt(static_cast<double>(units));
  const double z = normal_quantile(coverage.content);
  const std::vector<Node> deviations = deviation_nodes(static_cast<double>(units - 1));
  const auto confidence = [&](double k) {
    double sum = 0;
    for (const Node& s : deviations) sum += s.weight * normal_probability(root * (k * s.x - z));
    return sum;
  };
  return rising_root(confidence, coverage.confidence, -10, 10);
}

double two_sided_tolerance_factor(std::size_t units, const Coverage& coverage) {
  check("two_sided_tolerance_factor", units, coverage);
  const double root = std::sqrt(static_cast<double>(units));
  const auto freedom = static_cast<double>(units - 1);
  // Now x̄, then how far to either side the content needs.
  std::vector<Node> reaches = mean_nodes();
  for (Node& node : reaches) {
    const double mean = node.x / root;
    const auto content = [mean](double r) {
      return normal_probability(mean + r) - normal_probability(mean - r);
    };
    node.x = rising_root(content, coverage.content, 0, 1);
  }
  const auto confidence = [&](double k) {
    double sum = 0;
    for (const Node& r : reaches) {
      sum += r.weight * (1 - chi_square_probability(freedom * r.x * r.x / (k * k), freedom));
    }
    return sum;
  };
  return rising_root(confidence, coverage.confidence, 0, 10);
}

}  // namespace rvbench::analysis
