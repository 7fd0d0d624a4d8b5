#include "analysis/tpa/picard_powers.hpp"

#include <algorithm>
#include <string>

#include "hal/types/require.hpp"

namespace rvbench::analysis {

PicardPowers picard_powers(const LineSvd& svd, Eigen::Index line,
                           const Eigen::Ref<const Eigen::MatrixXcd>& responses) {
  constexpr Require require{"picard_powers"};
  require(line >= 0 && line < svd.left.lines, "no line " + std::to_string(line));
  require(responses.rows() == svd.left.rows,
          std::to_string(responses.rows()) + " responses of " + std::to_string(svd.left.rows));
  require(responses.cols() >= 1, "no record");
  require(responses.allFinite(), "a response is not finite");
  require(svd.singular_values(0, line) > 0, "line " + std::to_string(line) + " is 0");
  const double records = double(responses.cols());
  const auto left = svd.left[line];
  const Eigen::MatrixXcd along = left.adjoint() * responses;
  // What is left over, taken itself: as a difference of squares it would drown in rounding.
  const Eigen::MatrixXcd outside = responses - left * along;
  return {.singular_values = svd.singular_values.col(line),
          .powers = along.rowwise().squaredNorm() / records,
          .outside = outside.squaredNorm() / records,
          .rows = responses.rows()};
}

}  // namespace rvbench::analysis
