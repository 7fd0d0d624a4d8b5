#include "analysis/evidence/growth_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/statistics.hpp"
#include "hal/types/linear_algebra.hpp"

namespace rvbench::analysis {
namespace {

constexpr double least_range = 1.5;

struct Row {
  double load, speed, amplitude;  // logarithms
};

double amplitude(const Examination& point, std::size_t signature, std::size_t channel) {
  const std::vector<double>& amplitudes = point.scores[signature].channel_amplitudes;
  return channel < amplitudes.size() ? amplitudes[channel] : 0;
}

// Noise that swings has no amplitude.
bool counts(const Examination& point, std::size_t signature) {
  return point.load_pct > 0 && std::abs(point.speed_rpm) > 0 && !point.scores[signature].by_noise;
}

// Channels that show it at every point: sensors of unlike level must not come and go.
std::vector<std::size_t> common_channels(const std::vector<const Examination*>& points,
                                         std::size_t signature) {
  std::vector<std::size_t> channels;
  for (std::size_t c = 0; !points.empty() && c < points.front()->channels.size(); ++c) {
    const bool everywhere = std::ranges::all_of(points, [&](const Examination* point) {
      return !counts(*point, signature) || amplitude(*point, signature, c) > 0;
    });
    if (everywhere) channels.push_back(c);
  }
  return channels;
}

std::vector<Row> rows_of(const std::vector<const Examination*>& points, std::size_t signature) {
  const std::vector<std::size_t> channels = common_channels(points, signature);
  std::vector<Row> rows;
  for (const Examination* point : points) {
    if (channels.empty() || !counts(*point, signature)) continue;
    double sum = 0;
    for (const std::size_t c : channels) sum += std::log(amplitude(*point, signature, c));
    rows.push_back({std::log(point->load_pct), std::log(std::abs(point->speed_rpm)),
                    sum / static_cast<double>(channels.size())});
  }
  return rows;
}

bool varies(const std::vector<Row>& rows, double Row::*what) {
  const auto [least, most] = std::minmax_element(
      rows.begin(), rows.end(), [&](const Row& a, const Row& b) { return a.*what < b.*what; });
  return (*most).*what - (*least).*what >= std::log(least_range);
}

}  // namespace

GrowthLaw growth_law(const std::vector<const Examination*>& points, std::size_t signature) {
  const std::vector<Row> rows = rows_of(points, signature);
  GrowthLaw law;
  if (rows.empty()) return law;
  struct Term {
    double Row::*what;
    Growth* growth;
  };
  std::vector<Term> terms;
  if (varies(rows, &Row::load)) terms.push_back({&Row::load, &law.load});
  if (varies(rows, &Row::speed)) terms.push_back({&Row::speed, &law.speed});
  const auto n = static_cast<Eigen::Index>(rows.size());
  const auto unknowns = static_cast<Eigen::Index>(terms.size()) + 1;
  if (terms.empty() || n < unknowns + 2) return law;

  Eigen::MatrixXd a = Eigen::MatrixXd::Ones(n, unknowns);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Row& row = rows[static_cast<std::size_t>(i)];
    y[i] = row.amplitude;
    for (std::size_t k = 0; k < terms.size(); ++k) {
      a(i, static_cast<Eigen::Index>(k) + 1) = row.*terms[k].what;
    }
  }
  if (algebra::rank(a) < unknowns) return law;
  const Eigen::MatrixXd inverse = algebra::SymmetricFactors(algebra::gram(a)).inverse();
  const Eigen::VectorXd x = inverse * (a.transpose() * y);
  const auto freedom = static_cast<double>(n - unknowns);
  const double variance = (y - a * x).squaredNorm() / freedom;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k) + 1;
    const double deviation = std::sqrt(variance * inverse(at, at));
    *terms[k].growth = {x[at], t_of_p_value(0.05, freedom) * deviation, freedom};
  }
  return law;
}

double p_value_of_growth(const Growth& growth, const GrowthRange& range) {
  const double outside =
      std::max({range.least - growth.exponent, growth.exponent - range.most, 0.0});
  if (!std::isfinite(growth.exponent) || outside == 0) return 1;
  if (growth.error == 0) return 0;
  return t_p_value(outside / growth.error * t_of_p_value(0.05, growth.freedom), growth.freedom);
}

double odds_at_most(double p_value) {
  constexpr double e = std::numbers::e;
  if (p_value >= 1 / e) return 1;
  return p_value > 0 ? -e * p_value * std::log(p_value) : 0;
}

}  // namespace rvbench::analysis
