#pragma once

namespace rvbench::bench {

/// What a self-test does, and how far a sound station may be off. The defaults are those of a
/// bench like the article's with a sound reducer on it; a rig file states its own.
struct SelfTestSpec {
  double max_age_h = 24;
  bool tap = true;  ///< somebody has to tap on the housing
  double rest_s = 2;
  double noise_m_s2 = 0.1;  ///< rms: a tenth of what a healthy unit shakes by at work
  double noise_Nm = 0.05;   ///< rms
  double bias_m_s2 = 5;     ///< half of g: an AC-coupled input has none, and a tenth will do
  double bias_Nm = 0.2;     ///< 1 % of a transducer for 20 N·m
  double tap_m_s2 = 1;      ///< the least that a tap must show
  double tap_timeout_s = 20;
  double speed_rpm = 300;
  double speed_tolerance_pct = 10;  ///< an asynchronous motor slips, and a drive may not know it
  double brake_torque_Nm = 50;      ///< at the output
  double brake_tolerance_pct = 10;
  double gear_ratio = 121;           ///< of the unit on the bench
  double torque_tolerance_pct = 40;  ///< a reducer's losses are in it
  // Where the shaft is stopped at once: as of the plans that are shipped, and above what a sound
  // bench shows at so slow a speed.
  double most_input_torque_Nm = 8;
  double most_acceleration_m_s2 = 300;  ///< or 90 % of what the accelerometers can measure
  double most_housing_temp_degC = 60;
};

}  // namespace rvbench::bench
