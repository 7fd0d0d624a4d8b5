#include "analysis/tpa/matrix_inverse.hpp"

#include <algorithm>
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

void require_alike(const FrfMatrix& frfs, const OperatingSpectra& operating,
                   const std::vector<bool>& is_used) {
  constexpr Require require{"matrix_inverse_contributions"};
  require(is_on_lines_of(operating, frfs), "the spectra are not on the lines of the FRFs");
  require(operating.unit == frfs.response_unit,
          "spectra in \"" + operating.unit + "\", FRFs in \"" + frfs.response_unit + "\"");
  require(Index(is_used.size()) == operating.grid.lines,
          std::to_string(is_used.size()) + " marks of lines that are used");
}

void weight_rows(LineMatrices& matrices, const Eigen::VectorXd& weights) {
  for (Index line = 0; line < matrices.lines; ++line) {
    matrices[line] = weights.asDiagonal() * Eigen::MatrixXcd(matrices[line]);
  }
}

// Indicators' FRFs and responses, weighted alike.
struct Weighted {
  FrfMatrix frfs;
  LineMatrices responses;
  Eigen::VectorXd weights;
};

Weighted weighted(FrfMatrix frfs, LineMatrices responses, const std::vector<bool>& is_used) {
  const Eigen::VectorXd weights = inverse_rms(responses, is_used);
  weight_rows(frfs.values, weights);
  weight_rows(responses, weights);
  const Eigen::VectorXd squares = weights.cwiseAbs2().replicate(frfs.values.columns, 1);
  if (frfs.noise.size() > 0) frfs.noise = squares.asDiagonal() * frfs.noise;
  return {std::move(frfs), std::move(responses), weights};
}

struct ChosenLines {
  std::vector<Regularisation> rules;
  Eigen::VectorXd noise;  // of an indicator, mean square
};

ChosenLines chosen(const Weighted& indicators, const LineSvd& svd, const RegularisationRule& rule,
                   const std::vector<bool>& is_used, unsigned threads) {
  const FrfMatrix& frfs = indicators.frfs;
  Eigen::VectorXd floors =
      Eigen::VectorXd::Constant(frfs.values.lines, std::numeric_limits<double>::quiet_NaN());
  if (frfs.noise.size() > 0) floors = noise_floors(frfs);
  const double freedom = double(std::max<Index>(frfs.values.rows - frfs.values.columns, 1));
  ChosenLines lines{std::vector<Regularisation>(is_used.size()),
                    Eigen::VectorXd::Zero(frfs.values.lines)};
  const auto one = [&](std::size_t i) {
    const Index line = Index(i);
    if (!is_used[i] || !(svd.singular_values(0, line) > 0)) return;
    const PicardPowers powers = picard_powers(svd, line, indicators.responses[line]);
    lines.rules[i] = rule({powers, floors[line]});
    lines.noise[line] = powers.outside / freedom;
  };
  parallel_for(is_used.size(), one, threads);
  return lines;
}

Eigen::MatrixXd carried(const LineMatrices& inverse, const Eigen::VectorXd& noise) {
  Eigen::MatrixXd of_forces(inverse.rows, inverse.lines);
  for (Index line = 0; line < inverse.lines; ++line) {
    of_forces.col(line) = noise[line] * inverse[line].rowwise().squaredNorm();
  }
  return of_forces;
}

// The inverse, taking indicators as they are.
LineMatrices of_unweighted(LineMatrices inverse, const Eigen::VectorXd& weights) {
  for (Index line = 0; line < inverse.lines; ++line) {
    inverse[line] = Eigen::MatrixXcd(inverse[line]) * weights.asDiagonal();
  }
  return inverse;
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
  constexpr Require require{"matrix_inverse_contributions"};
  if (is_used.empty()) is_used.assign(std::size_t(frfs.values.lines), true);
  require_alike(frfs, operating, is_used);
  const Weighted indicators = weighted(rows_of(frfs, roles.indicators()),
                                       rows_of(operating, roles.indicators()).values, is_used);
  const LineMatrices& matrix = indicators.frfs.values;
  require(matrix.rows >= matrix.columns, std::to_string(matrix.rows) + " indicators for " +
                                             std::to_string(matrix.columns) + " paths");
  const LineSvd svd = line_svd(matrix, threads);
  ChosenLines lines = chosen(indicators, svd, rule, is_used, threads);
  RegularisedInverse inverse = regularised_inverse(svd, std::move(lines.rules), threads);
  LineMatrices forces = product(inverse.values, indicators.responses, threads);
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
          std::move(is_used),
          carried(inverse.values, lines.noise),
          roles.indicators(),
          of_unweighted(std::move(inverse.values), indicators.weights)};
}

PathContributions over_blocks(PathContributions whole, const std::vector<Index>& blocks) {
  whole.forces = columns_of(whole.forces, blocks);
  whole.measured_targets = columns_of(whole.measured_targets, blocks);
  return whole;
}

}  // namespace rvbench::analysis
