#include "sequences/plan_on_rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>

#include "hal/types/measure.hpp"
#include "sequences/limits_on_plan.hpp"

namespace rvbench::sequences {
namespace {

using Phases = std::vector<std::unique_ptr<Phase>>;

constexpr double same_rate = 0.01;

// At each phase that is too fast or too heavy; which of its values it is, the number says.
void add_phases(const char* stage, const Phases& phases, const TestPlan& plan, const hal::Rig& rig,
                std::vector<hal::ConfigFault>& faults) {
  const double max_rpm = rig.drive->limits().max_speed_rpm;
  const double max_Nm = rig.brake->limits().max_torque_Nm;
  for (std::size_t i = 0; i < phases.size(); ++i) {
    double speed_rpm = 0, torque_Nm = 0;
    for (const Segment& segment : phases[i]->timeline(plan.specimen)) {
      speed_rpm = std::max(speed_rpm, std::abs(segment.speed_rpm));
      torque_Nm = std::max(torque_Nm, segment.output_torque_Nm);
    }
    const std::string place = fmt::format("/{}/{}", stage, i);
    if (speed_rpm > max_rpm) {
      faults.push_back({0, place,
                        fmt::format("the plan asks for {:g} rpm, the drive can do {:g} rpm",
                                    speed_rpm, max_rpm)});
    }
    if (torque_Nm > max_Nm) {
      faults.push_back({0, place,
                        fmt::format("the plan asks for {:g} N·m, the brake can do {:g} N·m",
                                    torque_Nm, max_Nm)});
    }
  }
}

// Of the shafts a rig samples what its TorqueSensor does, and that is at the input.
bool is_recorded(std::string_view channel) {
  using namespace channel_names;
  return channel == input_torque || channel == input_angle;
}

void add_limits(const std::vector<Limit>& limits, std::vector<hal::ConfigFault>& faults) {
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const Limit& limit = limits[i];
    const Measure* measure = find_measure(limit.measure);
    if (measure == nullptr || measure->shaft_channels.empty()) continue;
    std::vector<std::string_view> missing;
    std::ranges::copy_if(measure->shaft_channels, std::back_inserter(missing),
                         std::not_fn(is_recorded));
    const bool of_one = !limit.of.empty();
    if (of_one && !is_recorded(limit.of)) missing = {limit.of};
    if (missing.empty()) continue;
    faults.push_back({0, fmt::format("/limits/{}/{}", i, of_one ? "of" : "measure"),
                      fmt::format("{} takes {}, which the rig does not record: it would end the "
                                  "run INVALID",
                                  limit.measure, fmt::join(missing, " and "))});
  }
}

}  // namespace

std::vector<hal::ConfigFault> faults_of_plan_on(const hal::Rig& rig, const TestPlan& plan) {
  std::vector<hal::ConfigFault> faults;
  add_phases("setup", plan.setup, plan, rig, faults);
  add_phases("main", plan.main, plan, rig, faults);
  add_limits(plan.limits, faults);
  std::ranges::move(limits_without_points(plan.limits, plan), std::back_inserter(faults));
  const double rate_Hz = rig.accelerometers->rate_Hz();
  const double asked_Hz = plan.acceleration_rate_Hz;
  if (!(std::abs(rate_Hz - asked_Hz) <= same_rate * asked_Hz)) {
    faults.push_back({0, "/acceleration_rate_Hz",
                      fmt::format("the accelerometers run at {:g} Hz, the plan asks for {:g} Hz",
                                  rate_Hz, asked_Hz)});
  }
  // Of a recording the range may not be known, which is no contradiction: false for NaN.
  const double range_m_s2 = rig.accelerometers->range_m_s2();
  if (plan.interlocks.acceleration_m_s2 >= range_m_s2) {
    faults.push_back(
        {0, "/interlocks/acceleration_m_s2",
         fmt::format("the acceleration interlock of {:g} m/s² could never trip: the accelerometers "
                     "show no more than {:g} m/s²",
                     plan.interlocks.acceleration_m_s2, range_m_s2)});
  }
  return faults;
}

}  // namespace rvbench::sequences
