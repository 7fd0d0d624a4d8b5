#include "analysis/indicators/power_transmission.hpp"

#include <cmath>

#include "hal/types/require.hpp"

namespace rvbench::analysis {

std::optional<double> torque_ripple(const Eigen::Ref<const Eigen::VectorXd>& torque_Nm) {
  constexpr Require require{"torque_ripple"};
  require(torque_Nm.size() >= 1 && torque_Nm.allFinite(), "needs at least 1 finite sample");
  const double mean_Nm = std::abs(torque_Nm.mean());
  if (!(mean_Nm > 0)) return std::nullopt;
  return (torque_Nm.maxCoeff() - torque_Nm.minCoeff()) / mean_Nm;
}

double mean_power_W(const Eigen::Ref<const Eigen::VectorXd>& torque_Nm,
                    const Eigen::Ref<const Eigen::VectorXd>& speed_rad_s) {
  constexpr Require require{"mean_power_W"};
  require(torque_Nm.size() == speed_rad_s.size() && torque_Nm.size() >= 1,
          "needs as many torques as speeds, and at least 1");
  require(torque_Nm.allFinite() && speed_rad_s.allFinite(), "sample not finite");
  return torque_Nm.dot(speed_rad_s) / double(torque_Nm.size());
}

std::optional<double> efficiency(double input_power_W, double output_power_W) {
  if (!std::isfinite(input_power_W) || !std::isfinite(output_power_W)) return std::nullopt;
  if (input_power_W > 0 && output_power_W > 0) return output_power_W / input_power_W;
  if (input_power_W < 0 && output_power_W < 0) return input_power_W / output_power_W;
  return std::nullopt;
}

}  // namespace rvbench::analysis
