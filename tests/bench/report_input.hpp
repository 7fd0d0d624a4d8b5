#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "bench/report/report.hpp"
#include "hal/types/units.hpp"
#include "tests/bench/judgements.hpp"

/// What a report is made of: a unit that failed on an RV-20E's orders.
namespace rvbench::test {

inline constexpr double rate_Hz = 4960;

inline analysis::Kinematics rv20e() {
  analysis::Kinematics kinematics;
  kinematics.machine = "RV-20E";
  kinematics.period_turns = 121;
  kinematics.orders = {
      {"input shaft", 1, "1", "input_shaft", "Drive shaft frequency"},
      {"sun-planet mesh", 1080.0 / 121, "1080/121", "sun_gear", "Planetary gear meshing frequency"},
      {"cycloid orbit", 39.0 / 121, "39/121", "crank", "Cycloid meshing frequency"},
      {"crank in carrier", 40.0 / 121, "40/121", "crank", ""},
      {"pin pass", 78.0 / 121, "78/121", "pin_housing", "Pin tooth meshing frequency"}};
  analysis::Signature signature;
  signature.component = "input_shaft";
  signature.depth_limit = 0.2;
  kinematics.signatures = {signature};
  return kinematics;
}

// A 700 Hz carrier whose amplitude swings once per turn of a shaft that speeds up from 9 to 11
// turns a second.
inline Recording chirped(double seconds) {
  const auto count = static_cast<Eigen::Index>(seconds * rate_Hz);
  Channel accel{{"accel_1x", "m/s²", "+X", not_known}, rate_Hz, 0, Eigen::VectorXd(count)};
  Channel angle{{"input_angle", "rad", "", not_known}, rate_Hz, 0, Eigen::VectorXd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const double t = double(i) / rate_Hz;
    angle.samples[i] = units::two_pi * (9 * t + t * t / seconds);
    accel.samples[i] = (1 + 0.5 * std::cos(angle.samples[i])) * std::sin(units::two_pi * 700 * t);
  }
  Recording record;
  record.source = "recording.h5#000";
  record.speed_rpm = 600;
  record.channels = {accel, angle};
  return record;
}

inline bench::ReportInput failed_input() {
  bench::ReportInput input;
  input.judgement = failed_run();
  input.kinematics = rv20e();
  input.load = [](std::size_t) { return std::optional<Recording>(chirped(4)); };
  input.plan_json = "{ \"name\": \"<quick>\" }";
  input.rig_json = "{}";
  input.hashes = {{"plan.json", std::string(64, 'a')}};
  return input;
}

}  // namespace rvbench::test
