#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace rvbench::analysis {

/// A reducer's loop: wound up one way and back, on one grid of torsion.
struct HysteresisLoop {
  double first_rad = 0;                   ///< torsion of the grid's first point
  double step_rad = 0;                    ///< > 0
  Eigen::VectorXd rising_Nm, falling_Nm;  ///< while the torsion grows, and while it shrinks
  double minus_rad = 0, plus_rad = 0;     ///< torsion where −3 and +3 % of rated is passed on

  /// What the reducer passes on: the mean of both branches. Friction is half of what parts them.
  Eigen::VectorXd passed_Nm() const { return (rising_Nm + falling_Nm) / 2; }
};

/// Mean over repeated loops.
struct LoopMean {
  double value = 0;
  double error = 0;  ///< half of its 95 % interval, from the scatter of the loops; NaN of one loop
};

/// What a hysteresis test tells. What it cannot tell is empty, and why is said.
struct Hysteresis {
  std::optional<LoopMean> lost_motion_rad;       ///< at ±3 % of the rated torque
  std::optional<LoopMean> width_rad;             ///< hysteresis loss: of the loop at no torque
  std::optional<LoopMean> stiffness_Nm_per_rad;  ///< from 50 to 100 % of the rated torque
  std::vector<HysteresisLoop> loops;
  std::vector<std::string> cannot_tell;  ///< "stiffness: the loops do not reach ..."
};

/// Lost motion, hysteresis loss and torsional stiffness of a reducer whose output is held while its
/// input is wound to and fro.
///
/// A branch lasts from one turn of the torsion to the next; one that rises and one that falls
/// make a loop. A reducer that is driven shows its friction in the torque: T = T_passed ±
/// T_friction at one torsion. So the mean of both branches *at one torsion* is what it passes on,
/// and
///
///     lost motion  torsion at T_passed = +3 % less that at −3 %: clearance, and what yields there
///     stiffness    slope of T_passed from 50 to 100 %, least squares, mean of both directions
///     width        torsion at T = 0 of the falling branch less that of the rising one
///
/// The makers' mean line is that of the torsions at one torque. It is the same where the loop is
/// narrower in torque than ±3 %, as it is with the torque at the output; where friction passes
/// ±3 %, as it does seen from the input, a clearance would not show in it.
///
/// Shape   N samples of each, taken at the same times, over one reversal to and fro or more
/// Units   N·m and rad, both at the output; rated_Nm likewise
/// Limits  an output that slips within a loop by less than a tenth of it goes unseen; an error is
///         of the scatter alone, not of the sensors
/// Errors  throws std::invalid_argument: different numbers of samples, one not finite, rated_Nm not
///         above 0
/// Source  Nabtesco, "Backlash" (nabtesco.de/en/faq/backlash) and catalogue Precision Reduction
/// Gear
///         RV, hysteresis curve; GB/T 40731-2021 for lost motion; the mean at one torsion is ours
Hysteresis hysteresis(const Eigen::Ref<const Eigen::VectorXd>& torque_Nm,
                      const Eigen::Ref<const Eigen::VectorXd>& torsion_rad, double rated_Nm);

}  // namespace rvbench::analysis
