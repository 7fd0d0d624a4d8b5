#include "analysis/tpa/unexplained_power.hpp"

#include <algorithm>
#include <vector>

#include "analysis/tpa/line_svd.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;

// What FRFs' errors make of the forces, all rows together.
double power_of_errors(const Eigen::Ref<const Eigen::VectorXd>& variances, Index rows,
                       const Eigen::Ref<const Eigen::VectorXd>& force_powers) {
  return variances.reshaped(rows, force_powers.size()).colwise().sum() * force_powers;
}

// Of what is outside per degree of freedom, at the lines that are used.
double floor_of(const Eigen::VectorXd& outside, const std::vector<bool>& is_used, double freedom) {
  std::vector<double> powers;
  for (std::size_t line = 0; line < is_used.size(); ++line) {
    if (is_used[line]) powers.push_back(outside[Index(line)] / freedom);
  }
  if (powers.empty()) return 0;
  const auto tenth = powers.begin() + std::ptrdiff_t(powers.size() / 10);
  std::nth_element(powers.begin(), tenth, powers.end());
  return *tenth;
}

}  // namespace

UnexplainedPower unexplained_power(const FrfMatrix& frfs, const OperatingSpectra& operating,
                                   const SensorRoles& roles,
                                   const PathContributions& contributions) {
  constexpr Require require{"unexplained_power"};
  const FrfMatrix indicators = rows_of(frfs, roles.indicators());
  const LineMatrices responses = rows_of(operating, roles.indicators()).values;
  const Index rows = responses.rows, paths = indicators.values.columns, lines = responses.lines;
  require(rows > paths, "as many paths as indicators, nothing can be outside");
  require(indicators.variances.size() > 0, "the variances of the FRFs are not known");
  const LineSvd svd = line_svd(indicators.values);
  const double freedom = double(rows - paths), each = 1 / double(responses.columns);
  UnexplainedPower power{Eigen::VectorXd::Zero(lines), Eigen::VectorXd::Zero(lines),
                         Eigen::VectorXd::Zero(lines)};
  Eigen::VectorXd outside_of = Eigen::VectorXd::Zero(rows), total_of = outside_of;
  for (Index line = 0; line < lines; ++line) {
    if (!contributions.is_used[std::size_t(line)]) continue;
    const auto left = svd.left[line];
    const Eigen::MatrixXcd outside = responses[line] - left * (left.adjoint() * responses[line]);
    const Eigen::VectorXd force_powers =
        contributions.forces[line].cwiseAbs2().rowwise().sum() * each;
    power.outside[line] = outside.squaredNorm() * each;
    power.total[line] = responses[line].squaredNorm() * each;
    power.expected[line] = freedom / double(rows) *
                           power_of_errors(indicators.variances.col(line), rows, force_powers);
    outside_of += outside.rowwise().squaredNorm();
    total_of += responses[line].rowwise().squaredNorm();
  }
  const double floor = floor_of(power.outside, contributions.is_used, freedom);
  for (Index line = 0; line < lines; ++line) {
    if (contributions.is_used[std::size_t(line)]) power.expected[line] += floor * freedom;
  }
  outside_of.cwiseQuotient(total_of.cwiseMax(1e-300)).maxCoeff(&power.worst_indicator);
  return power;
}

}  // namespace rvbench::analysis
