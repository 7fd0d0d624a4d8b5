#include "sequences/interlock_check.hpp"

#include <fmt/format.h>

#include <cmath>

namespace rvbench::sequences {
namespace {

Ending trip(std::string reason) {
  return {Outcome::error, ErrorKind::safety_trip, std::move(reason)};
}

Ending beyond(const char* what, double value, double limit, const char* unit) {
  return trip(
      fmt::format("{} {:.4g} {} is above the interlock's {:g} {}", what, value, unit, limit, unit));
}

double largest_torque_Nm(const hal::TorqueBlock& block) {
  double largest = 0;
  for (const hal::TorqueSample& sample : block.samples) {
    if (std::abs(sample.torque_Nm) > largest) largest = std::abs(sample.torque_Nm);
  }
  return largest;
}

double largest_acceleration_m_s2(const hal::AccelerationBlock& block) {
  float largest = 0;
  for (const float sample : block.scans.reshaped()) {
    if (std::abs(sample) > largest) largest = std::abs(sample);  // false for NaN
  }
  return double(largest);
}

std::optional<Ending> check_safety(const Interlocks& limits, const hal::SafetyStatus& safety) {
  if (safety.estop_pressed) return trip("the emergency stop is pressed");
  if (safety.guard_open) return trip("the guard is open");
  if (safety.housing_temp_degC > limits.housing_temp_degC) {
    return beyond("housing temperature", safety.housing_temp_degC, limits.housing_temp_degC,
                  "degC");
  }
  return std::nullopt;
}

}  // namespace

std::optional<Ending> check_interlocks(const Interlocks& limits, const FreshValues& fresh) {
  if (fresh.safety) {
    if (auto ending = check_safety(limits, *fresh.safety)) return ending;
  }
  if (fresh.torque) {
    const double torque_Nm = largest_torque_Nm(*fresh.torque);
    if (torque_Nm > limits.input_torque_Nm) {
      return beyond("input torque", torque_Nm, limits.input_torque_Nm, "N·m");
    }
  }
  for (const double speed_rpm :
       {fresh.speed_rpm, fresh.drive ? fresh.drive->speed_rpm : not_known}) {
    if (std::abs(speed_rpm) > limits.input_speed_rpm) {
      return beyond("input speed", std::abs(speed_rpm), limits.input_speed_rpm, "rpm");
    }
  }
  if (fresh.accelerations) {
    const double peak_m_s2 = largest_acceleration_m_s2(*fresh.accelerations);
    if (peak_m_s2 > limits.acceleration_m_s2) {
      return beyond("acceleration", peak_m_s2, limits.acceleration_m_s2, "m/s²");
    }
  }
  return std::nullopt;
}

std::optional<Ending> check_devices(const FreshValues& fresh) {
  if (fresh.drive && fresh.drive->tripped) {
    return device_lost(
        fmt::format("the drive has tripped, fault code {}", fresh.drive->fault_code));
  }
  if (fresh.drive && !fresh.drive->remote) {
    return device_lost("the drive obeys its panel: somebody took it over");
  }
  if (fresh.brake && fresh.brake->tripped) {
    return device_lost("the brake has tripped");
  }
  return std::nullopt;
}

Ending device_lost(std::string reason) {
  return {Outcome::error, ErrorKind::device_lost, std::move(reason)};
}

}  // namespace rvbench::sequences
