#include "analysis/evidence/growth_law.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr double least_range = 1.5;

struct Row {
  double load, speed, amplitude;  // logarithms
};

std::optional<Row> row_of(const Examination& point, std::size_t signature) {
  const std::vector<double>& depths = point.scores[signature].channel_depths;
  double sum = 0;
  int channels = 0;
  for (std::size_t c = 0; c < std::min(depths.size(), point.channels.size()); ++c) {
    const double amplitude = depths[c] * point.channels[c].rms;
    if (!(amplitude > 0)) continue;
    sum += std::log(amplitude);
    ++channels;
  }
  if (channels == 0 || !(point.load_pct > 0) || !(std::abs(point.speed_rpm) > 0)) return {};
  return Row{std::log(point.load_pct), std::log(std::abs(point.speed_rpm)), sum / channels};
}

bool varies(const std::vector<Row>& rows, double Row::*what) {
  const auto [least, most] = std::minmax_element(
      rows.begin(), rows.end(), [&](const Row& a, const Row& b) { return a.*what < b.*what; });
  return (*most).*what - (*least).*what >= std::log(least_range);
}

}  // namespace

GrowthLaw growth_law(const std::vector<const Examination*>& points, std::size_t signature) {
  std::vector<Row> rows;
  for (const Examination* point : points) {
    if (const std::optional<Row> row = row_of(*point, signature)) rows.push_back(*row);
  }
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
  const Eigen::MatrixXd inverse =
      (a.transpose() * a).ldlt().solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
  const Eigen::VectorXd x = inverse * (a.transpose() * y);
  const auto freedom = static_cast<double>(n - unknowns);
  const double variance = (y - a * x).squaredNorm() / freedom;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k) + 1;
    *terms[k].growth = {x[at], t_of_p_value(0.05, freedom) * std::sqrt(variance * inverse(at, at))};
  }
  return law;
}

}  // namespace rvbench::analysis
