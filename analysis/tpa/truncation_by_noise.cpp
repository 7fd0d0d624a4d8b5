#include "analysis/tpa/truncation_by_noise.hpp"

#include <cmath>
#include <string>

#include "hal/types/require.hpp"

namespace rvbench::analysis {

double noise_floor(const Eigen::Ref<const Eigen::MatrixXd>& variances) {
  constexpr Require require{"noise_floor"};
  require(variances.size() > 0, "no variances");
  require(variances.allFinite() && variances.minCoeff() >= 0,
          "a variance is negative or not finite");
  return std::sqrt(variances.rowwise().sum().maxCoeff()) +
         std::sqrt(variances.colwise().sum().maxCoeff());
}

Eigen::VectorXd noise_floors(const FrfMatrix& frfs) {
  constexpr Require require{"noise_floors"};
  const LineMatrices& values = frfs.values;
  require(frfs.noise.cols() == values.lines, "the noise of the FRFs is not known");
  Eigen::VectorXd floors(values.lines);
  for (Eigen::Index line = 0; line < values.lines; ++line) {
    floors[line] =
        noise_floor(Eigen::MatrixXd(frfs.noise.col(line).reshaped(values.rows, values.columns)));
  }
  return floors;
}

Regularisation truncate_by_noise(const Eigen::Ref<const Eigen::VectorXd>& singular_values,
                                 double floor) {
  constexpr Require require{"truncate_by_noise"};
  require(std::isfinite(floor) && floor >= 0, "floor " + std::to_string(floor));
  return {.kept = (singular_values.array() > floor).count()};
}

}  // namespace rvbench::analysis
