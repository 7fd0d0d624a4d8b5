#include "analysis/indicators/hysteresis_record.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/indicators/one_clock.hpp"
#include "analysis/smallest_step.hpp"
#include "hal/types/measure.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

using namespace channel_names;

constexpr double most_of_range = 0.5;
constexpr double steps_of_motion = 10;

// How far an angle went each way, by its largest return, and its smallest step.
struct Travel {
  double up_rad = 0, down_rad = 0, range_rad = 0, step_rad = 0;
};

Travel travel_of(const Eigen::VectorXd& angle_rad) {
  Travel t;
  t.step_rad = smallest_step(angle_rad);
  double least = not_known, most = not_known;
  for (const double rad : angle_rad) {
    if (!std::isfinite(rad)) continue;
    least = std::fmin(least, rad);
    most = std::fmax(most, rad);
    t.up_rad = std::max(t.up_rad, rad - least);
    t.down_rad = std::max(t.down_rad, most - rad);
  }
  t.range_rad = std::max(t.up_rad, t.down_rad);
  return t;
}

Hysteresis nothing_of(std::string why) {
  Hysteresis nothing;
  nothing.cannot_tell.push_back(std::move(why));
  return nothing;
}

}  // namespace

bool is_hysteresis_test(const Recording& record) {
  const Channel* angle = record.find(input_angle);
  if (angle == nullptr || record.find(input_torque) == nullptr) return false;
  const Travel t = travel_of(angle->samples);
  return std::min(t.up_rad, t.down_rad) >= most_of_range * t.range_rad &&
         t.range_rad >= steps_of_motion * t.step_rad && t.range_rad > 0;
}

Hysteresis hysteresis_of(const Recording& record, const Kinematics& kinematics) {
  const double ratio = kinematics.gear_ratio, rated_Nm = kinematics.rated_output_torque_Nm;
  if (!(ratio > 0)) return nothing_of("the gear ratio of " + kinematics.machine + " is not known");
  if (!(rated_Nm > 0)) {
    return nothing_of(
        "the rated torque is not known: the kinematics does not state a "
        "rated_output_torque_Nm");
  }
  const Channel* angle = record.find(input_angle);
  const Channel* driving = record.find(input_torque);
  if (!have_one_clock(driving, angle)) {
    return nothing_of("torque and angle of the input do not have one clock");
  }
  const Channel* output_at = record.find(output_angle);
  const Channel* output = record.find(output_torque);
  Eigen::VectorXd torsion_rad = angle->samples / ratio;
  if (have_one_clock(output_at, angle)) torsion_rad -= output_at->samples;
  const Eigen::VectorXd torque_Nm =
      have_one_clock(output, angle) ? output->samples : Eigen::VectorXd(ratio * driving->samples);
  Eigen::VectorXd known_Nm(torque_Nm.size()), known_rad(torque_Nm.size());
  Eigen::Index known = 0;
  for (Eigen::Index i = 0; i < torque_Nm.size(); ++i) {
    if (!std::isfinite(torque_Nm[i]) || !std::isfinite(torsion_rad[i])) continue;
    known_Nm[known] = torque_Nm[i];
    known_rad[known++] = torsion_rad[i];
  }
  return hysteresis(known_Nm.head(known), known_rad.head(known), rated_Nm);
}

std::vector<Indicator> hysteresis_indicators(const Hysteresis& told) {
  namespace names = measure_names;
  std::vector<Indicator> list;
  const auto add = [&](std::string_view measure, const std::optional<LoopMean>& of, double factor,
                       const char* unit) {
    if (!of) return;
    list.push_back({std::string(measure), "", factor * of->value, unit, factor * of->error});
  };
  constexpr double arcmin_per_rad = units::arcmin_from_rad(1);
  add(names::lost_motion, told.lost_motion_rad, arcmin_per_rad, "arcmin");
  add(names::torsional_stiffness, told.stiffness_Nm_per_rad, 1 / arcmin_per_rad, "N·m/arcmin");
  add(names::hysteresis_width, told.width_rad, arcmin_per_rad, "arcmin");
  return list;
}

}  // namespace rvbench::analysis
