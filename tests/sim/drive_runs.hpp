#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "sim/effect_edits.hpp"
#include "sim/effect_sites.hpp"
#include "sim/plant_files.hpp"
#include "sim/rv_plant.hpp"
#include "sim/steady_state.hpp"
#include "tests/sim/plant_texts.hpp"

// The RV-20E's bench with faults of its motor, inverter and brake: by orders, in time, by hand.

namespace rvbench::test {

using Complex = std::complex<double>;

inline constexpr double two_pi = 2 * std::numbers::pi;
inline constexpr double supply_Hz = 60, brake_Nm = 100;

inline std::vector<sim::EffectSite> sites(const sim::PlantSpec& plant, const std::string& effect) {
  return sim::sites_of(plant, *sim::standard_terms().find(effect));
}

inline sim::PlantSpec shipped(const std::string& name) {
  return std::get<0>(sim::read_plant(name));
}

inline sim::PlantSpec bench_with(const std::string& effect, const sim::Parameters& parameters) {
  const sim::PlantSpec bench = sim::rv20e_bench();
  return sim::with_effect(bench, effect, sites(bench, effect).at(0), parameters);
}

inline sim::PlantSpec with_rotor_bar(double depth) {
  return bench_with("rotor_bar", {{"depth", {depth, "1"}}, {"phase", {0.7, "rad"}}});
}

inline sim::PlantSpec with_brake_ripple(double depth, double per_turn) {
  return bench_with(
      "brake_ripple",
      {{"depth", {depth, "1"}}, {"phase", {0.7, "rad"}}, {"per_turn", {per_turn, "1"}}});
}

inline sim::PlantSpec with_speed_modulation(double depth) {
  return bench_with("speed_modulation",
                    {{"depth", {depth, "1"}}, {"phase", {0.7, "rad"}}, {"frequency", {3, "Hz"}}});
}

inline sim::SteadyState steady(const sim::PlantSpec& plant, double load_Nm = brake_Nm) {
  const auto made = std::get<0>(sim::SteadyPlant::make(plant));
  return std::get<0>(made.under(Eigen::Vector2d(supply_Hz, load_Nm), made.orders_up_to(1100)));
}

/// The amplitude of the first output at the frequency of a term that keeps its own time.
inline std::optional<double> find_timed_line(const sim::SteadyState& state, double frequency_Hz) {
  for (std::size_t i = 0; i < state.rhythms_Hz.size(); ++i) {
    if (std::abs(state.rhythms_Hz[i] - frequency_Hz) < 1e-6) {
      return std::abs(state.outputs[0].timed_lines[Eigen::Index(i)]);
    }
  }
  return std::nullopt;
}

inline double timed_line(const sim::SteadyState& state, double frequency_Hz) {
  const auto line = find_timed_line(state, frequency_Hz);
  REQUIRE(line);
  return *line;
}

/// Twice the frequency of what the rotor's bars carry, from the motor's speed: two pole pairs.
inline double twice_slip_Hz(const sim::SteadyState& state) {
  return 2 * (supply_Hz - 2 * state.speed_rad_s[0] / two_pi);
}

/// The motor by Kloss's formula at a state's mean slip, where its torque rises with the slip speed.
struct Linearised {
  explicit Linearised(const sim::SteadyState& state) {
    const double nominal_rad_s = two_pi * 25 * 0.15;  // slip speed at pull-out
    const double x = two_pi * twice_slip_Hz(state) / 4 / nominal_rad_s;
    torque_Nm = 24 * x / (1 + x * x);
    slope_Nms = 24 / nominal_rad_s * (1 - x * x) / std::pow(1 + x * x, 2);
    curvature_Nms2 = 48 / std::pow(nominal_rad_s, 2) * x * (x * x - 3) / std::pow(1 + x * x, 3);
  }
  /// What holds all bodies together against a swing of the motor's speed, N·m·s. The planets turn
  /// at a third of the sun's speed, the output at its 121st part.
  Complex held(double at_Hz) const {
    const double inertia_kgm2 = 2.05e-3 + 2 * 2e-5 / 9 + 0.33 / 121 / 121;
    const double drag_Nms = 5e-4 + 0.5 / 121 / 121;
    return {slope_Nms + drag_Nms, two_pi * at_Hz * inertia_kgm2};
  }
  double torque_Nm = 0, slope_Nms = 0, curvature_Nms2 = 0;
};

/// The first output as the plant is integrated in time, settled.
class InTime {
 public:
  InTime(sim::PlantSpec plant, double length_s) {
    const sim::SteadyState state = steady(plant);
    for (std::size_t i = 0; i < plant.bodies.size(); ++i) {
      plant.bodies[i].start_speed = state.speed_rad_s[Eigen::Index(i)];
    }
    const auto held = [&](double value) {
      return Eigen::VectorXd::Constant(Eigen::Index((settling_s + length_s) * rate_Hz), value);
    };
    const auto shown = run_of(plant, {channel_of("supply", "Hz", rate_Hz, held(supply_Hz)),
                                      channel_of("brake_torque", "N·m", rate_Hz, held(brake_Nm))});
    samples_ = shown[0].samples.tail(Eigen::Index(length_s * rate_Hz));
  }

  double mean() const { return samples_.mean(); }
  double line(double frequency_Hz) const {  // with a Hann window
    Complex sum = 0;
    const Eigen::Index n = samples_.size();
    const double mean = samples_.mean();
    for (Eigen::Index i = 0; i < n; ++i) {
      const double window = 1 - std::cos(two_pi * double(i) / double(n));
      const double turns = frequency_Hz * double(i) / rate_Hz;
      sum += window * (samples_[i] - mean) * std::polar(1.0, -two_pi * turns);
    }
    return 2.0 / double(n) * std::abs(sum);
  }

 private:
  static constexpr double rate_Hz = 1000, settling_s = 2;
  Eigen::VectorXd samples_;
};

}  // namespace rvbench::test
