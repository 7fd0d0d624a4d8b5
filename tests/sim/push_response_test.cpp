#include "sim/push_response.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "sim/rv_plant.hpp"
#include "sim/steady_state.hpp"
#include "tests/sim/plant_texts.hpp"

using namespace rvbench;
using Complex = std::complex<double>;

namespace {

constexpr double two_pi = 2 * std::numbers::pi;

// Two wheels of 0.002 and 0.05 kg·m² on a shaft of 30 N·m/rad and 0.01 N·m·s/rad; the second one
// runs in 0.02 N·m·s/rad, the first is pushed. The transducer shows half of the shaft's torque.
sim::PlantSpec two_wheels() {
  return test::plant_of(R"({"plant": "wheels", "bodies": [
    {"name": "rotor", "motion": "rotation", "inertia": {"value": 0.002, "unit": "kg·m²"}},
    {"name": "wheel", "motion": "rotation", "inertia": {"value": 0.05, "unit": "kg·m²"}}],
    "terms": [
    {"type": "spring", "body_a": "rotor", "body_b": "wheel", "name": "shaft",
     "parameters": {"stiffness": {"value": 30, "unit": "N·m/rad"}}},
    {"type": "damper", "body_a": "rotor", "body_b": "wheel", "name": "shaft_loss",
     "parameters": {"damping": {"value": 0.01, "unit": "N·m·s/rad"}}},
    {"type": "viscous_friction", "body_a": "wheel", "name": "drag",
     "parameters": {"damping": {"value": 0.02, "unit": "N·m·s/rad"}}}],
    "inputs": [{"channel": "torque", "unit": "N·m", "is": "force", "body": "rotor"}],
    "outputs": [{"channel": "speed", "unit": "rad/s", "is": "speed", "body": "rotor"},
                {"channel": "twist", "unit": "N·m", "is": "effort", "term": "shaft",
                 "gain": {"value": 0.5, "unit": "1"}}]})");
}

struct Solved {
  sim::SteadyState state;
  sim::PushResponse response;
};

Solved solved(const sim::PlantSpec& plant, const Eigen::VectorXd& inputs, int orders,
              const std::vector<double>& frequencies_Hz) {
  const auto made = sim::SteadyPlant::make(plant);
  REQUIRE(std::holds_alternative<sim::SteadyPlant>(made));
  const auto& steady = std::get<sim::SteadyPlant>(made);
  const auto lines = steady.orders_up_to(orders);
  auto state = steady.under(inputs, lines);
  REQUIRE(std::holds_alternative<sim::SteadyState>(state));
  auto response = steady.response(std::get<sim::SteadyState>(state), inputs, lines, frequencies_Hz);
  REQUIRE(response);
  return {std::get<sim::SteadyState>(std::move(state)), *std::move(response)};
}

}  // namespace

SCENARIO("two wheels on a shaft answer forces as two equations by hand say", "[sim][steady]") {
  const double frequency_Hz = GENERATE(3.0, 20.0, 60.0);  // below, near and above the resonance
  const auto found = solved(two_wheels(), Eigen::VectorXd::Constant(1, 0.5), 4, {frequency_Hz});
  const Complex s(0, two_pi * frequency_Hz);
  const Complex shaft = 30.0 + 0.01 * s;
  const Complex rotor = 0.002 * s * s + shaft;
  const Complex wheel = 0.05 * s * s + 0.02 * s + shaft;
  const Complex det = rotor * wheel - shaft * shaft;
  // Angles of rotor and wheel for torques on them.
  const auto twist = [&](double on_rotor, double on_wheel) {
    const Complex rotor_rad = (wheel * on_rotor + shaft * on_wheel) / det;
    const Complex wheel_rad = (shaft * on_rotor + rotor * on_wheel) / det;
    return shaft * (rotor_rad - wheel_rad);
  };
  const Eigen::MatrixXcd& lines = found.response.lines.front();
  REQUIRE(found.response.sites.size() == 3);
  THEN("a torque on a wheel shows through the shaft") {
    CHECK(std::abs(lines(1, 0) - 0.5 * twist(1, 0)) < 1e-6);
    CHECK(std::abs(lines(1, 1) - 0.5 * twist(0, 1)) < 1e-6);
    CHECK(std::abs(lines(0, 0) - s * wheel / det) < 1e-6 * std::abs(s * wheel / det));
  }
  THEN("a torque in the shaft is passed through the transducer, less what the wheels give way") {
    CHECK(found.response.sites[2].name == "shaft");
    CHECK(found.response.sites[2].on == "rotor");
    CHECK(found.response.sites[2].is_joint);
    CHECK(std::abs(lines(1, 2) - 0.5 * (1.0 + twist(-1, 1))) < 1e-6);
  }
  THEN("a constant torque on either turns both faster; only the drag's comes through the shaft") {
    CHECK(found.response.means(0, 0) == Approx(1 / 0.02));
    CHECK(found.response.means(0, 1) == Approx(1 / 0.02));
    CHECK(found.response.means(1, 0) == Approx(0.5));
    CHECK(found.response.means(1, 1) == Approx(0).margin(1e-6));
    CHECK(found.response.slowest_rad_s[0] == Approx(1 / 0.02));
  }
}

SCENARIO("the RV bench under a little more load is where its response says", "[sim][steady]") {
  const sim::PlantSpec plant = sim::rv20e_bench();
  const Eigen::Vector2d inputs(605 / 60.0 * 2, 100), more(605 / 60.0 * 2, 101);
  const auto before = solved(plant, inputs, 200, {90});
  const auto after = solved(plant, more, 200, {90});
  Eigen::Index brake = 0;
  while (before.response.sites[std::size_t(brake)].name != "brake") ++brake;
  const double torque_Nm = after.state.outputs[0].mean - before.state.outputs[0].mean;
  CHECK(torque_Nm == Approx(1 / 121.0).epsilon(0.01));  // as the ratio of the reducer says
  CHECK(-before.response.means(0, brake) == Approx(torque_Nm).epsilon(1e-3));
  CHECK(-before.response.slowest_rad_s[brake] ==
        Approx(after.state.slowest_rad_s - before.state.slowest_rad_s).epsilon(0.02));
}
