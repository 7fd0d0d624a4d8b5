#include <boost/numeric/odeint.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/sim/plant_texts.hpp"

using namespace rvbench;

namespace {

// Two masses that show most of what the engine must follow at once.
const std::string machine = R"plant({
  "plant": "two masses",
  "bodies": [
    {"name": "a", "motion": "translation", "mass": {"value": 2, "unit": "kg"}},
    {"name": "b", "motion": "translation", "mass": {"value": 1, "unit": "kg"}}
  ],
  "terms": [
    {"type": "spring", "body_a": "a", "body_b": "b",
     "parameters": {"stiffness": {"value": 800, "unit": "N/m"}}},
    {"type": "damper", "body_a": "a", "body_b": "b",
     "parameters": {"damping": {"value": 2, "unit": "N·s/m"}}},
    {"type": "cubic_stiffness", "body_a": "a", "body_b": "b",
     "parameters": {"stiffness": {"value": 2e5, "unit": "N/m³"}}},
    {"type": "nonlinear_damping", "body_a": "b",
     "parameters": {"damping": {"value": 3, "unit": "N·s²/m²"}}},
    {"type": "stiffness_hysteresis", "body_a": "b",
     "parameters": {"stiffness": {"value": 200, "unit": "N/m"},
                    "yield": {"value": 0.01, "unit": "m"}}},
    {"type": "coulomb_friction", "body_a": "a",
     "parameters": {"level": {"value": 1, "unit": "N"},
                    "creep_speed": {"value": 0.05, "unit": "m/s"}}},
    {"type": "stribeck_friction", "body_a": "a",
     "parameters": {"excess": {"value": 0.5, "unit": "N"},
                    "stribeck_speed": {"value": 0.1, "unit": "m/s"},
                    "creep_speed": {"value": 0.05, "unit": "m/s"}}},
    {"type": "external_force", "body_a": "b",
     "parameters": {"amplitude": {"value": 10, "unit": "N"}, "phase": {"value": 0, "unit": "rad"},
                    "frequency": {"value": 3, "unit": "Hz"}}},
    {"type": "cascade_controller", "body_a": "a", "set_point": "wanted",
     "parameters": {"position_gain": {"value": 8, "unit": "Hz"},
                    "speed_gain": {"value": 20, "unit": "N·s/m"},
                    "integral_time": {"value": 0.5, "unit": "s"}}}
  ],
  "inputs": [{"channel": "wanted", "unit": "m", "is": "signal", "between_samples": "linear"}],
  "outputs": [
    {"channel": "a", "unit": "m", "is": "position", "body": "a"},
    {"channel": "b", "unit": "m", "is": "position", "body": "b"},
    {"channel": "va", "unit": "m/s", "is": "speed", "body": "a"}
  ]
})plant";

// The same machine, written out from its drawing: xa xb va vb, the elastic way, the integral.
void written_out(const std::vector<double>& x, std::vector<double>& dx, double t) {
  const double stretch = x[0] - x[1], rate = x[2] - x[3];
  const double joint = 800 * stretch + 2 * rate + 2e5 * std::pow(stretch, 3);
  const double drag = 3 * x[3] * std::abs(x[3]);
  const double dry = (1 + 0.5 * std::exp(-std::pow(x[2] / 0.1, 2))) * std::tanh(x[2] / 0.05);
  const double error = 8 * (0.1 * t - x[0]) - x[2];
  const double drive = 20 * (error + x[5] / 0.5);
  dx[0] = x[2];
  dx[1] = x[3];
  dx[2] = (drive - joint - dry) / 2;
  dx[3] = (joint - drag - 200 * x[4] + 10 * std::cos(6 * std::numbers::pi * t)) / 1;
  dx[4] = x[3] * x[4] > 0 ? x[3] * (1 - std::abs(x[4]) / 0.01) : x[3];
  dx[5] = error;
}

}  // namespace

TEST_CASE("a plant moves as an independent integrator says", "[sim][simulate][literature]") {
  constexpr Eigen::Index n = 1001;
  constexpr double rate_Hz = 500;
  const auto plant = test::plant_of(machine);
  // A set-point that moves at 0.1 m/s.
  const Eigen::VectorXd ramp = Eigen::VectorXd::LinSpaced(n, 0, 0.1 * (n - 1) / rate_Hz);
  const auto out = test::run_of(plant, {test::channel_of("wanted", "m", rate_Hz, ramp)});

  namespace odeint = boost::numeric::odeint;
  using State = std::vector<double>;
  auto stepper = odeint::make_controlled(1e-11, 1e-11, odeint::runge_kutta_dopri5<State>());
  State x(6, 0.0);
  double farthest_m = 0, farthest_m_s = 0, widest_m = 0, fastest_m_s = 0;
  for (Eigen::Index i = 1; i < n; ++i) {
    odeint::integrate_adaptive(stepper, written_out, x, double(i - 1) / rate_Hz,
                               double(i) / rate_Hz, 1e-5);
    farthest_m = std::max(
        {farthest_m, std::abs(out[0].samples[i] - x[0]), std::abs(out[1].samples[i] - x[1])});
    farthest_m_s = std::max(farthest_m_s, std::abs(out[2].samples[i] - x[2]));
    widest_m = std::max(widest_m, std::abs(x[0] - x[1]));
    fastest_m_s = std::max(fastest_m_s, std::abs(x[2]));
  }
  CAPTURE(farthest_m, farthest_m_s, widest_m, fastest_m_s);
  CHECK(widest_m > 0.01);  // the cubic spring works
  CHECK(farthest_m < 1e-3 * widest_m);
  CHECK(farthest_m_s < 1e-3 * fastest_m_s);
}
