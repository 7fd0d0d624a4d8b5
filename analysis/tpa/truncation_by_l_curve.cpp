#include "analysis/tpa/truncation_by_l_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "analysis/tpa/parameter_search.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;
using Point = Eigen::Vector2d;

// Rounding is what remains where nothing does.
constexpr double smallest = 1e-30;

std::vector<Point> l_curve(const PicardPowers& line) {
  const Index n = line.singular_values.size();
  const double total = line.powers.sum() + line.outside;
  std::vector<Point> points;
  double norm = 0;
  for (Index k = 0; k < n; ++k) {
    const double s = line.singular_values[k];
    if (s == 0) break;
    norm += line.powers[k] / (s * s);
    const double rest = line.powers.tail(n - k - 1).sum() + line.outside;
    points.push_back({std::log(std::max(rest, smallest * total)) / 2,
                      std::log(std::max(norm, std::numeric_limits<double>::min())) / 2});
  }
  return points;
}

// Cosine of the angle at b; and whether the way a, b, c turns as an L does, seen from its corner.
double cosine_at(const Point& a, const Point& b, const Point& c) {
  const Point to_a = a - b, to_c = c - b;
  const double lengths = to_a.norm() * to_c.norm();
  return lengths > 0 ? to_a.dot(to_c) / lengths : -1;
}
bool is_corner(const Point& a, const Point& b, const Point& c) {
  const Point along = b - a, on = c - b;
  return along.x() * on.y() - along.y() * on.x() < 0;
}

}  // namespace

Regularisation truncate_by_l_curve(const PicardPowers& line) {
  require_powers("truncate_by_l_curve", line);
  const std::vector<Point> points = l_curve(line);
  // Cosine of 7π/8, from the source: duller ones are no corner.
  double sharpest = std::cos(7 * std::numbers::pi / 8);
  std::size_t corner = points.empty() ? 0 : points.size() - 1;
  for (std::size_t j = 0; j + 2 < points.size(); ++j) {
    for (std::size_t k = j + 1; k + 1 < points.size(); ++k) {
      const double cosine = cosine_at(points[j], points[k], points.back());
      if (cosine <= sharpest || !is_corner(points[j], points[k], points.back())) continue;
      sharpest = cosine;
      corner = k;
    }
  }
  return {.kept = points.empty() ? 0 : Index(corner) + 1};
}

}  // namespace rvbench::analysis
