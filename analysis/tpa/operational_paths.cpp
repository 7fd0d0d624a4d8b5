#include "analysis/tpa/operational_paths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "analysis/tpa/line_svd.hpp"
#include "analysis/tpa/picard_powers.hpp"
#include "analysis/tpa/regularised_inverse.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;

constexpr double least_size = 0.01;  // of the largest singular value

// A row per block.
LineMatrices by_blocks(const LineMatrices& sensors, const Eigen::VectorXd& weights) {
  LineMatrices turned = LineMatrices::unset(sensors.columns, sensors.rows, sensors.lines);
  for (Index line = 0; line < sensors.lines; ++line) {
    turned[line] = (weights.asDiagonal() * sensors[line]).adjoint();
  }
  return turned;
}

std::vector<Regularisation> rules_of(const LineSvd& svd, const LineMatrices& targets,
                                     const RegularisationRule& rule) {
  std::vector<Regularisation> rules(std::size_t(targets.lines));
  for (Index line = 0; line < targets.lines; ++line) {
    if (!(svd.singular_values(0, line) > 0)) continue;
    rules[std::size_t(line)] =
        rule({picard_powers(svd, line, targets[line]), std::numeric_limits<double>::quiet_NaN()});
  }
  return rules;
}

// Filter factors: 1 of a singular value that is taken whole, 0 of one that is not.
Eigen::VectorXd ways_of(const LineSvd& svd, const std::vector<Regularisation>& rules) {
  Eigen::VectorXd ways = Eigen::VectorXd::Zero(Index(rules.size()));
  for (Index line = 0; line < ways.size(); ++line) {
    const Regularisation& rule = rules[std::size_t(line)];
    for (Index k = 0; k < rule.kept; ++k) {
      const double size = svd.singular_values(k, line);
      if (size < least_size * svd.singular_values(0, line)) continue;
      ways[line] += size * rule.weight(k, size);
    }
  }
  return ways;
}

bool same_lines(const LineGrid& a, const LineGrid& b) {
  return a.lines == b.lines && std::abs(a.first_Hz - b.first_Hz) < 1e-6 * a.step_Hz &&
         std::abs(a.step_Hz - b.step_Hz) < 1e-6 * a.step_Hz;
}

}  // namespace

OperationalPaths operational_paths(const OperatingSpectra& learnt, const OperatingSpectra& held_out,
                                   const std::vector<DegreeOfFreedom>& references,
                                   const std::vector<DegreeOfFreedom>& targets,
                                   const RegularisationRule& rule) {
  constexpr Require require{"operational_paths"};
  require(!references.empty() && !targets.empty(), "no reference or no target");
  require(same_lines(learnt.grid, held_out.grid),
          "blocks to learn from and others differ in lines");
  require(learnt.values.columns >= Index(references.size()),
          std::to_string(learnt.values.columns) + " blocks to learn from, for " +
              std::to_string(references.size()) + " references");
  for (const DegreeOfFreedom& place : references) {
    require(std::find(targets.begin(), targets.end(), place) == targets.end(),
            place.point + " is both reference and target");
  }
  LineMatrices x = rows_of(learnt, references).values;
  const Eigen::VectorXd weights = inverse_rms(x);
  const LineMatrices y =
      by_blocks(rows_of(learnt, targets).values, Eigen::VectorXd::Ones(Index(targets.size())));
  const LineMatrices others = rows_of(held_out, references).values;
  const LineSvd svd = line_svd(by_blocks(x, weights));
  RegularisedInverse inverse = regularised_inverse(svd, rules_of(svd, y, rule));
  LineMatrices transmissibilities(y.columns, x.rows, x.lines);
  LineMatrices synthesised(y.columns, others.columns, x.lines);
  for (Index line = 0; line < x.lines; ++line) {
    transmissibilities[line] = (inverse.values[line] * y[line]).adjoint() * weights.asDiagonal();
    synthesised[line] = transmissibilities[line] * others[line];
  }
  const std::vector<bool> all(std::size_t(x.lines), true);
  Eigen::VectorXd ways = ways_of(svd, inverse.lines);
  return {references,
          targets,
          std::move(transmissibilities),
          std::move(x),
          std::move(inverse.lines),
          OnBoardValidation(rows_of(held_out, targets), std::move(synthesised), all),
          std::move(ways)};
}

}  // namespace rvbench::analysis
