#include "sim/rv_train.hpp"

#include <boost/numeric/odeint.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/sim/rv_train.hpp"

using namespace rvbench;

namespace {

constexpr double two_pi = 2 * std::numbers::pi;

double stored_J(const sim::Plant& plant) {
  double sum = 0;
  for (const auto& term : plant.terms()) sum += term->stored_energy_J(plant.state());
  return sum;
}

double dissipated_W(const sim::Plant& plant) {
  double sum = 0;
  for (const auto& term : plant.terms()) sum += term->dissipated_power_W(plant.state());
  return sum;
}

// The train's equations of motion for two planets, written out from the article's figure and not
// from the terms: angles q0 motor, q1 sun, q2 q3 planets in the carrier, q4 carrier, q5 brake.
class WrittenOut {
 public:
  using State = std::vector<double>;

  explicit WrittenOut(const test::RvTrainSpec& spec) : s_(spec) {}

  void operator()(const State& x, State& dx, double) const {
    const double* q = x.data();
    const double* v = q + 6;
    const double coupling = 600 * (q[0] - q[1]) + 0.05 * (v[0] - v[1]);
    const double output = 6e4 * (q[4] - q[5]) + 20 * (v[4] - v[5]);
    const double slip = (two_pi * s_.supply_Hz / 2 - v[0]) / (two_pi * 25);
    const double motor = 2 * 12.0 / (slip / 0.15 + 0.15 / slip);
    double on_sun = 0, on_carrier = 0;
    for (int k = 0; k < 2; ++k) {
      const double planet = q[2 + k], planet_speed = v[2 + k];
      const double seen = q[1] - q[4] - std::numbers::pi * k;
      double error = 0, ripple = 0;
      for (int h = 1; h <= 4; ++h) {
        error += s_.profile_m / h * std::cos(9 * h * seen + 0.5 * h);
        ripple += s_.mesh_ripple / h * std::cos(9 * h * seen + 0.5 * h + 1);
      }
      const double pressed = 5.3e-3 * (q[1] - q[4]) - 15.9e-3 * planet + error;
      const double rate = 5.3e-3 * (v[1] - v[4]) - 15.9e-3 * planet_speed;
      const double tooth = 8e7 * (1 + ripple) * pressed + 1000 * rate;
      const double orbit = planet - q[4];
      const double lag = planet / 40 - q[4] + s_.crank_error_m / 52e-3 * std::cos(orbit + 0.2) +
                         s_.pin_ripple_m / 52e-3 * std::cos(40 * orbit);
      const double discs = 84e3 * lag + 40 * (planet_speed / 40 - v[4]);
      on_sun -= 5.3e-3 * tooth;
      on_carrier += 5.3e-3 * tooth + discs;
      dx[static_cast<std::size_t>(8 + k)] = (15.9e-3 * tooth - discs / 40) / 2e-5;
    }
    for (std::size_t i = 0; i < 6; ++i) dx[i] = v[i];
    const double bearing = s_.bearing_coulomb_Nm * std::tanh(v[1] / 2) + 5e-4 * v[1];
    const double brake = s_.brake_coulomb_Nm * std::tanh(v[5] / 0.05) + 0.5 * v[5];
    dx[6] = (motor - coupling) / 2e-3;
    dx[7] = (coupling + on_sun - bearing) / 5e-5;
    dx[10] = (on_carrier - output) / 0.03;
    dx[11] = (output - brake) / 0.3;
  }

 private:
  test::RvTrainSpec s_;
};

// How far a plant strayed from the integrator's solution, at worst.
struct Farthest {
  double angle_rad = 0, speed_rad_s = 0;

  void take(const sim::Plant& plant, const WrittenOut::State& x) {
    for (int i = 0; i < 6; ++i) {
      const auto at = static_cast<std::size_t>(i);
      angle_rad = std::max(angle_rad, std::abs(plant.state().q[i] - x[at]));
      speed_rad_s = std::max(speed_rad_s, std::abs(plant.state().v[i] - x[at + 6]));
    }
  }
};

}  // namespace

TEST_CASE("a wound-up train that is let go keeps its energy book", "[sim][plant][law]") {
  const double damping = GENERATE(0.0, 1.0);
  const double coulomb_Nm = GENERATE(0.0, 0.15);
  test::SteppedTrain train(
      {.step_s = 1e-6, .bearing_coulomb_Nm = coulomb_Nm, .damping_factor = damping});
  sim::Plant& plant = train.plant();
  Eigen::VectorXd winding = Eigen::VectorXd::Zero(6);
  winding[0] = 0.5;
  plant.shift(winding);
  const double start_J = stored_J(plant);
  CHECK(start_J == Approx(0.5 * 600 * 0.25));
  double lost_J = 0;
  for (int i = 0; i < 50000; ++i) {
    const double before_W = dissipated_W(plant);
    train.step();
    lost_J += 0.5 * (before_W + dissipated_W(plant)) * plant.step_s();
  }
  CHECK(lost_J > 0.01 * start_J);  // else the book would balance without its losses
  // The trapezoidal rule for the integral of the power leaves (10 kHz · 1 µs)² = 1e-4 of it.
  CHECK(plant.kinetic_energy_J() + stored_J(plant) + lost_J == Approx(start_J).epsilon(1e-4));
}

TEST_CASE("the train moves as an independent integrator says", "[sim][plant][literature]") {
  test::RvTrainSpec spec{.step_s = 1.0 / 19840,
                         .supply_Hz = 40,
                         .profile_m = 2e-6,
                         .mesh_ripple = 0.08,
                         .crank_error_m = 2.08e-6,
                         .pin_ripple_m = 1.04e-6,
                         .brake_coulomb_Nm = 40};
  const WrittenOut equations(spec);
  test::SteppedTrain coarse(spec);
  spec.step_s /= 2;
  test::SteppedTrain fine(spec);
  WrittenOut::State x(12, 0.0);
  namespace odeint = boost::numeric::odeint;
  auto stepper =
      odeint::make_controlled(1e-10, 1e-10, odeint::runge_kutta_dopri5<WrittenOut::State>());
  Farthest of_coarse, of_fine;
  for (int block = 0; block < 50; ++block) {  // from rest through the motor's pull-out
    constexpr int steps = 200;
    const double length_s = steps * coarse.plant().step_s();
    odeint::integrate_adaptive(stepper, std::cref(equations), x, block * length_s,
                               (block + 1) * length_s, 1e-6);
    for (int i = 0; i < steps; ++i) coarse.step();
    for (int i = 0; i < 2 * steps; ++i) fine.step();
    of_coarse.take(coarse.plant(), x);
    of_fine.take(fine.plant(), x);
  }
  CAPTURE(of_coarse.angle_rad, of_coarse.speed_rad_s, of_fine.angle_rad, of_fine.speed_rad_s);
  CHECK(x[6] > 100);  // it came up to speed
  // So near that even the smallest deviation would be missed: 2e-5 rad of pin ripple; and of the
  // speed, a fortieth of what 2 µm of profile do at the sun (radius 5.3 mm) 9 times a turn, and as
  // much in each of its four harmonics.
  CHECK(of_coarse.angle_rad < 2e-5);
  CHECK(of_coarse.speed_rad_s < 4 * 2e-6 / 5.3e-3 * 9 * 125 / 40);
  // By halving the step one finds the order: nearer to the two that Plant promises than to one.
  CHECK(std::log2(of_coarse.angle_rad / of_fine.angle_rad) > 1.5);
}

SCENARIO("angles are wrapped by whole output turns, unless a part of the plant keeps count",
         "[sim][plant]") {
  const auto turned = [](const sim::PlantSpec& plant) {
    sim::RvTrain train(plant, sim::draw_unit("healthy", 1), 1.0 / 19840);
    train.set_supply(100, true);
    double before_rad = 0, torque_Nm = 0, largest_jump_Nm = 0;
    bool goes_on = true;
    for (int i = 0; i < 6 * 19840; ++i) {
      train.step();
      torque_Nm = train.input_torque_Nm();
      train.wrap();
      largest_jump_Nm = std::max(largest_jump_Nm, std::abs(train.input_torque_Nm() - torque_Nm));
      goes_on = goes_on && train.input_angle_rad() > before_rad - 1e-3;
      before_rad = train.input_angle_rad();
    }
    CHECK(goes_on);
    CHECK(before_rad > 2 * 121 * two_pi);
    CHECK(largest_jump_Nm < 1e-8);
    return train.shaft_angle_rad();
  };
  CHECK(turned(sim::rv20e_bench()) < 121 * two_pi + 1);
  const auto counting = sim::with_effect(sim::rv20e_bench(), "cubic_stiffness", {.body_a = "brake"},
                                         {{"stiffness", {1e-3, "N·m/rad³"}}});
  CHECK(turned(counting) > 2 * 121 * two_pi);
}
