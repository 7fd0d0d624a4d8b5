#include "analysis/indicators/shaft_indicators.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "analysis/indicators/one_clock.hpp"
#include "analysis/indicators/power_transmission.hpp"
#include "analysis/indicators/transmission_error.hpp"
#include "hal/types/measure.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

namespace names = measure_names;

// The first samples of a channel, over whole periods; empty where there is none or one is lost.
Eigen::VectorXd whole_periods(const Recording& record, std::string_view name,
                              const ShaftAngle& angle, double period_turns) {
  const Channel* x = record.find(name);
  if (x == nullptr || !(x->rate_Hz > 0)) return {};
  const double periods =
      angle.whole_periods(x->samples.size(), x->rate_Hz, x->start_s, period_turns);
  if (!(periods >= 1)) return {};
  const double end_turns = angle.turns_at(x->start_s) + periods * period_turns;
  const double length_s = angle.times_s(end_turns, 1, 1)[0] - x->start_s;
  const auto count = std::min<Eigen::Index>(x->samples.size(), std::llround(length_s * x->rate_Hz));
  if (count < 3 || !x->samples.head(count).allFinite()) return {};
  return x->samples.head(count);
}

bool one_clock(const Recording& record, std::initializer_list<std::string_view> channels) {
  const Channel* first = record.find(*channels.begin());
  return std::ranges::all_of(
      channels, [&](std::string_view name) { return have_one_clock(record.find(name), first); });
}

// Mean power of a shaft, by central differences of its angle.
double power_W(const Eigen::VectorXd& torque_Nm, const Eigen::VectorXd& angle_rad, double rate_Hz) {
  const Eigen::Index n = torque_Nm.size() - 2;
  const Eigen::VectorXd speed_rad_s = (angle_rad.tail(n) - angle_rad.head(n)) * rate_Hz / 2;
  return mean_power_W(torque_Nm.segment(1, n), speed_rad_s);
}

}  // namespace

std::vector<Indicator> shaft_indicators(const Recording& record, const ShaftAngle& angle,
                                        const Kinematics& kinematics) {
  using namespace channel_names;
  const auto part = [&](std::string_view name) {
    return whole_periods(record, name, angle, kinematics.period_turns);
  };
  std::vector<Indicator> list;
  const auto add = [&](std::string_view measure, std::string_view of, std::optional<double> value,
                       const char* unit) {
    if (value) list.push_back({std::string(measure), std::string(of), *value, unit});
  };

  const Eigen::VectorXd input_Nm = part(input_torque), output_Nm = part(output_torque);
  if (input_Nm.size() > 0) add(names::torque_ripple, input_torque, torque_ripple(input_Nm), "1");
  if (output_Nm.size() > 0) add(names::torque_ripple, output_torque, torque_ripple(output_Nm), "1");

  if (!one_clock(record, {input_angle, output_angle})) return list;
  const Eigen::VectorXd input_rad = part(input_angle), output_rad = part(output_angle);
  if (input_rad.size() == 0 || output_rad.size() == 0) return list;
  const double rate_Hz = record.find(input_angle)->rate_Hz;
  if (one_clock(record, {input_angle, input_torque, output_torque}) && input_Nm.size() > 0 &&
      output_Nm.size() > 0) {
    add(names::efficiency, "",
        efficiency(power_W(input_Nm, input_rad, rate_Hz), power_W(output_Nm, output_rad, rate_Hz)),
        "1");
  }
  const auto error_rad = transmission_error(input_rad, output_rad, units::two_pi);
  if (error_rad) add(names::transmission_error, "", units::arcsec_from_rad(*error_rad), "arcsec");
  return list;
}

}  // namespace rvbench::analysis
