#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace rvbench::analysis {

/// Means of a steadily turning machine under one condition, at a torque transducer between the two
/// sides of its shaft, beside what a model makes of them.
struct TransducerMeans {
  Eigen::Vector2d apart;           ///< measured − predicted: torque [N·m], speed [rad/s]
  Eigen::Vector2d standard_error;  ///< of these
  /// Column 0: what torque and speed gain per N·m of drive on the left; column 1: of drag on the
  /// right, both at the transducer.
  Eigen::Matrix2d response;
  double torque_Nm = 0;    ///< predicted: the load
  double speed_rad_s = 0;  ///< predicted, without sign
};

enum class Side { left, right };

/// By how much the torque on one side of the transducer differs from the model's.
struct SideBalance {
  Side side = Side::left;  ///< left: the drive; right: the drag
  double mean_Nm = 0;      ///< over the conditions: measured − the model's
  double standard_error_Nm = 0;
  double least_Nm = 0, most_Nm = 0;  ///< of its law under any of the conditions
  double per_load = 0;               ///< N·m per N·m of the transducer's torque; 0: may be chance
  double per_load_error = 0;
  double per_speed = 0;  ///< N·m per rad/s; 0: may be chance
  double per_speed_error = 0;
};

/// On which side of a torque transducer means differ.
///
///     left    T_drive(supply, ω) − T_transducer = 0
///     right   T_transducer − T_drag(load, ω) = 0
///
/// Both are linear about the model's state: torque and speed together tell the two torques. Their
/// law over load and speed is a weighted regression over conditions. What may be chance in it
/// (p > 0.01) is left out, and standard errors grow where conditions scatter by more than theirs.
///
/// @return of each side that differs by more than chance; empty for fewer than five conditions, and
///         where torque and speed answer both sides alike
/// Units   N·m, rad/s. Errors  none thrown: standard errors are above 0
/// Source  Draper & Smith, Applied Regression Analysis (1998), ch. 15: backward elimination
std::vector<SideBalance> torque_balances(const std::vector<TransducerMeans>& conditions);

const char* to_string(Side side) noexcept;  ///< "left", "right"

/// "the same at all loads and speeds", "rises with load, falls with speed"
std::string law_text(const SideBalance& balance);

}  // namespace rvbench::analysis
