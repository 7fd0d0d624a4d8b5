#include "analysis/tpa/matrix_inverse.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "analysis/tpa/picard_powers.hpp"
#include "analysis/tpa/regularised_inverse.hpp"
#include "analysis/tpa/truncation_by_noise.hpp"
#include "hal/types/parallel_for.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;
constexpr Require require{"matrix_inverse_contributions"};

void require_alike(const FrfMatrix& frfs, const OperatingSpectra& operating,
                   const std::vector<bool>& is_used) {
  const LineGrid& grid = operating.grid;
  require(grid.lines == frfs.values.lines && operating.values.lines == grid.lines &&
              std::abs(grid.first_Hz - frfs.first_Hz) < 1e-6 * frfs.step_Hz &&
              std::abs(grid.step_Hz - frfs.step_Hz) * double(grid.lines) < 0.05 * frfs.step_Hz,
          "the spectra are not on the lines of the FRFs");
  require(operating.unit == frfs.response_unit,
          "spectra in \"" + operating.unit + "\", FRFs in \"" + frfs.response_unit + "\"");
  require(Index(is_used.size()) == grid.lines,
          std::to_string(is_used.size()) + " marks of lines that are used");
}

std::vector<Regularisation> rules_of(const FrfMatrix& indicators, const LineSvd& svd,
                                     const LineMatrices& responses, const RegularisationRule& rule,
                                     const std::vector<bool>& is_used, unsigned threads) {
  Eigen::VectorXd floors =
      Eigen::VectorXd::Constant(responses.lines, std::numeric_limits<double>::quiet_NaN());
  if (indicators.variances.size() > 0) floors = noise_floors(indicators);
  std::vector<Regularisation> rules(is_used.size());
  const auto one = [&](std::size_t i) {
    const Index line = Index(i);
    if (!is_used[i] || !(svd.singular_values(0, line) > 0)) return;
    rules[i] = rule({picard_powers(svd, line, responses[line]), floors[line]});
  };
  parallel_for(is_used.size(), one, threads);
  return rules;
}

LineMatrices product(const LineMatrices& a, const LineMatrices& b, unsigned threads) {
  LineMatrices c = LineMatrices::unset(a.rows, b.columns, a.lines);
  parallel_for(
      std::size_t(a.lines),
      [&](std::size_t line) { c[Index(line)].noalias() = a[Index(line)] * b[Index(line)]; },
      threads);
  return c;
}

}  // namespace

PathContributions matrix_inverse_contributions(const FrfMatrix& frfs,
                                               const OperatingSpectra& operating,
                                               const SensorRoles& roles,
                                               const RegularisationRule& rule,
                                               std::vector<bool> is_used, unsigned threads) {
  if (is_used.empty()) is_used.assign(std::size_t(frfs.values.lines), true);
  require_alike(frfs, operating, is_used);
  const FrfMatrix indicators = rows_of(frfs, roles.indicators());
  const LineMatrices responses = rows_of(operating, roles.indicators()).values;
  require(indicators.values.rows >= indicators.values.columns,
          std::to_string(indicators.values.rows) + " indicators for " +
              std::to_string(indicators.values.columns) + " paths");
  const LineSvd svd = line_svd(indicators.values, threads);
  RegularisedInverse inverse = regularised_inverse(
      svd, rules_of(indicators, svd, responses, rule, is_used, threads), threads);
  LineMatrices forces = product(inverse.values, responses, threads);
  OperatingSpectra validation = rows_of(operating, roles.validation());
  LineMatrices synthesised = product(rows_of(frfs, roles.validation()).values, forces, threads);
  return {frfs.excitations,
          roles.targets(),
          operating.grid,
          std::move(forces),
          rows_of(frfs, roles.targets()).values,
          rows_of(operating, roles.targets()).values,
          OnBoardValidation(std::move(validation), std::move(synthesised), is_used),
          std::move(inverse.lines),
          std::move(inverse.conditions),
          std::move(is_used)};
}

}  // namespace rvbench::analysis
