#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "hal/types/recording.hpp"

namespace rvbench::test {

/// A reducer whose output a brake holds while its input is wound to and fro, written out and
/// integrated by another hand than the simulation's. SI; torques of the reducer at its output.
struct HeldReducer {
  double ratio = 121;
  double stiffness_Nm_per_rad = 168e3;                   // 48.9 N·m per arc minute
  double clearance_rad = std::numbers::pi / (180 * 60);  // 1 arc minute
  double friction_Nm = 0.15;                             // of the input shaft
  double brake_Nm = 250;                                 // holds up to it, and gives way beyond
  double peak_Nm = 190;                                  // passed on at the ends
  int reversals = 6;                                     // of the drive: of 6, the first is no loop
  double winding_rad_s = 0.1;                            // of the motor
  double torque_noise_Nm = 0.002;
  double counts_per_turn = 65536;  // of the angle
  bool has_output_angle = false;

  static constexpr double rate_Hz = 500;

  /// input_torque and input_angle, and output_angle if there is one.
  Recording recorded() const;

 private:
  using State = std::array<double, 3>;  // angle and speed of the input shaft, angle of the output

  double torsion_Nm(const State& x) const {
    const double way = x[0] / ratio - x[2];
    const double gap = clearance_rad / 2;
    return stiffness_Nm_per_rad * (way - std::clamp(way, -gap, gap));
  }
  double motor_rad(double t_s) const;
  double coupling_Nm(const State& x, double t_s) const { return 600 * (motor_rad(t_s) - x[0]); }
  double reach_rad() const {  // of the motor to each side
    return ratio * (peak_Nm / stiffness_Nm_per_rad + clearance_rad / 2) +
           (peak_Nm / ratio + friction_Nm) / 600;
  }
  double length_s() const { return reach_rad() * (2 * reversals + 1) / winding_rad_s; }
};

// From the middle to one end, then from end to end.
inline double HeldReducer::motor_rad(double t_s) const {
  const double way = t_s * winding_rad_s / reach_rad();
  const double in_period = std::fmod(way, 4.0);
  if (in_period < 1) return reach_rad() * in_period;
  return reach_rad() * (in_period < 3 ? 2 - in_period : in_period - 4);
}

inline Recording HeldReducer::recorded() const {
  const auto count = static_cast<Eigen::Index>(length_s() * rate_Hz);
  const auto channel = [&](std::string_view name, const char* unit) {
    return Channel{{std::string(name), unit, "", not_known}, rate_Hz, 0, Eigen::VectorXd(count)};
  };
  Channel torque = channel(channel_names::input_torque, "N·m");
  Channel input = channel(channel_names::input_angle, "rad");
  Channel output = channel(channel_names::output_angle, "rad");
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0, torque_noise_Nm > 0 ? torque_noise_Nm : 1e-12);
  const auto equations = [this](const State& x, State& dx, double t_s) {
    const double passed_Nm = torsion_Nm(x);
    const double input_Nm = coupling_Nm(x, t_s) - passed_Nm / ratio -
                            friction_Nm * std::tanh(x[1] / 0.02) - 0.05 * x[1];
    dx[0] = x[1];
    dx[1] = input_Nm / 2e-4;
    dx[2] = std::copysign(std::max(0.0, std::abs(passed_Nm) - brake_Nm), passed_Nm) / 1000;
  };
  boost::numeric::odeint::runge_kutta4<State> stepper;
  constexpr int steps = 60;  // per sample: the friction turns within 27 µs at a stroke
  const double step_rad = 2 * std::numbers::pi / counts_per_turn;
  State x{};
  for (Eigen::Index i = 0; i < count; ++i) {
    const double t_s = double(i) / rate_Hz;
    torque.samples[i] = coupling_Nm(x, t_s) + noise(generator);
    input.samples[i] = step_rad * std::floor(x[0] / step_rad);
    output.samples[i] = x[2];
    for (int k = 0; k < steps; ++k) {
      const double dt_s = 1 / (rate_Hz * steps);
      stepper.do_step(equations, x, t_s + k * dt_s, dt_s);
    }
  }
  Recording record;
  record.source = "held";
  record.channels = {torque, input};
  if (has_output_angle) record.channels.push_back(output);
  return record;
}

}  // namespace rvbench::test
