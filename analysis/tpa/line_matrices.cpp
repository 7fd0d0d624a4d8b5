#include "analysis/tpa/line_matrices.hpp"

#include <string>

#include "hal/types/require.hpp"

namespace rvbench::analysis {

LineMatrices columns_of(const LineMatrices& all, const std::vector<Eigen::Index>& columns) {
  constexpr Require require{"columns_of"};
  for (const Eigen::Index column : columns) {
    require(column >= 0 && column < all.columns, "no column " + std::to_string(column));
  }
  LineMatrices some = LineMatrices::unset(all.rows, Eigen::Index(columns.size()), all.lines);
  for (Eigen::Index line = 0; line < all.lines; ++line) {
    some[line] = all[line](Eigen::all, columns);
  }
  return some;
}

Eigen::VectorXd inverse_rms(const LineMatrices& rows, const std::vector<bool>& is_used) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(rows.rows);
  for (Eigen::Index line = 0; line < rows.lines; ++line) {
    if (is_used.empty() || is_used[std::size_t(line)])
      squares += rows[line].rowwise().squaredNorm();
  }
  const double loudest = squares.maxCoeff();
  if (!(loudest > 0)) return Eigen::VectorXd::Ones(rows.rows);
  return (squares / loudest).cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
}

}  // namespace rvbench::analysis
