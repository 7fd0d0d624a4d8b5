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

}  // namespace rvbench::analysis
