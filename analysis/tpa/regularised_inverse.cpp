#include "analysis/tpa/regularised_inverse.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "analysis/tpa/line_jobs.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;

void require_rules(const LineSvd& svd, const std::vector<Regularisation>& rules) {
  constexpr Require require{"regularised_inverse"};
  require(Index(rules.size()) == svd.left.lines,
          std::to_string(rules.size()) + " rules for " + std::to_string(svd.left.lines) + " lines");
  for (const Regularisation& rule : rules) {
    require(rule.kept >= 0 && rule.kept <= svd.left.columns,
            "keeps " + std::to_string(rule.kept) + " of " + std::to_string(svd.left.columns));
    require(std::isfinite(rule.parameter) && rule.parameter >= 0,
            "parameter " + std::to_string(rule.parameter));
  }
}

}  // namespace

RegularisedInverse regularised_inverse(const LineSvd& svd, std::vector<Regularisation> rules,
                                       unsigned threads, const SvdKernels& kernels) {
  require_rules(svd, rules);
  const Index m = svd.left.rows, n = svd.left.columns, lines = svd.left.lines;
  RegularisedInverse inverse{LineMatrices::unset(n, m, lines), std::move(rules),
                             Eigen::VectorXd(lines)};
  const auto invert = [&](Index from, Index to) {
    std::vector<double> weights(std::size_t(n), 0), scratch(std::size_t(4 * n * n));
    for (Index line = from; line < to; ++line) {
      const Regularisation& rule = inverse.lines[std::size_t(line)];
      const double* s = svd.singular_values.data() + line * n;
      for (Index k = 0; k < n; ++k) weights[std::size_t(k)] = rule.weight(k, s[k]);
      kernels.invert(svd.left.values.data() + line * m * n, svd.right.values.data() + line * n * n,
                     weights.data(), int(m), int(n), int(rule.kept), scratch.data(),
                     inverse.values.values.data() + line * m * n);
      inverse.conditions[line] =
          s[n - 1] > 0 ? s[0] / s[n - 1] : std::numeric_limits<double>::infinity();
    }
  };
  for_line_stretches(lines, invert, threads);
  return inverse;
}

}  // namespace rvbench::analysis
