#include "analysis/indicators/transmission_error.hpp"

#include <cmath>

#include "hal/types/require.hpp"

namespace rvbench::analysis {

std::optional<double> transmission_error(const Eigen::Ref<const Eigen::VectorXd>& input,
                                         const Eigen::Ref<const Eigen::VectorXd>& output,
                                         double output_turn) {
  constexpr Require require{"transmission_error"};
  require(input.size() == output.size() && input.size() >= 1, "needs as many angles of each");
  require(input.allFinite() && output.allFinite(), "an angle is not finite");
  require(output_turn > 0, "output_turn must be above 0");
  const Eigen::ArrayXd turned = (output.array() - output[0]).abs() / output_turn;
  const double whole = std::floor(turned.maxCoeff());
  if (whole < 1) return std::nullopt;
  Eigen::Index end = 1;
  while (turned[end] < whole) ++end;

  const double into = (whole - turned[end - 1]) / (turned[end] - turned[end - 1]);
  const auto at_end = [&](const Eigen::Ref<const Eigen::VectorXd>& angle) {
    return angle[end - 1] + into * (angle[end] - angle[end - 1]) - angle[0];
  };
  const double travelled = at_end(input);
  if (!(std::abs(travelled) > 0)) return std::nullopt;
  const double ratio = at_end(output) / travelled;
  const Eigen::VectorXd error = output.head(end + 1) - ratio * input.head(end + 1);
  return error.maxCoeff() - error.minCoeff();
}

}  // namespace rvbench::analysis
