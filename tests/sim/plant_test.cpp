#include "sim/plant.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "sim/terms/one_axis_term.hpp"

using namespace rvbench;

namespace {

// A constant torque on body 0, from outside the tree of terms.
class Push final : public sim::PhysicsTerm {
 public:
  explicit Push(double torque_Nm) : torque_Nm_(torque_Nm) {}
  std::string_view name() const override { return "push"; }
  void add_force(const sim::PlantState&, Eigen::Ref<Eigen::VectorXd> f) const override {
    f[0] += torque_Nm_;
  }
  void add_orders(const Eigen::VectorXd&, std::set<int>&) const override {}
  double stored_energy_J(const sim::PlantState&) const override { return 0; }
  double dissipated_power_W(const sim::PlantState&) const override { return 0; }

 private:
  double torque_Nm_;
};

// Drag of a fan on body 0: −c·v².
class Fan final : public sim::PhysicsTerm {
 public:
  explicit Fan(double c) : c_(c) {}
  std::string_view name() const override { return "fan"; }
  void add_force(const sim::PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const override {
    f[0] -= c_ * s.v[0] * s.v[0];
  }
  void add_orders(const Eigen::VectorXd&, std::set<int>&) const override {}
  double stored_energy_J(const sim::PlantState&) const override { return 0; }
  double dissipated_power_W(const sim::PlantState& s) const override {
    return c_ * std::pow(s.v[0], 3);
  }

 private:
  double c_;
};

template <typename... Terms>
sim::Plant plant_of(const Eigen::VectorXd& inertia, double step_s, const Terms&... terms) {
  sim::PlantModel model;
  model.inertia = inertia;
  model.start_position = model.start_speed = Eigen::VectorXd::Zero(inertia.size());
  (model.terms.push_back(std::make_unique<Terms>(terms)), ...);
  return sim::Plant(std::move(model), step_s);
}

// Two flywheels on a shaft, in closed form.
struct Flywheels {
  Eigen::Vector2d inertia{0.02, 0.03};
  double k = 50, c = 0.05;
  double reduced = 0.02 * 0.03 / 0.05;
  double omega0 = std::sqrt(k / reduced);  // 64.5 rad/s: 10.3 Hz
  double decay = c / (2 * reduced);
  double omega = std::sqrt(omega0 * omega0 - decay * decay);

  sim::LinearAxisTerm shaft() const { return sim::LinearAxisTerm("shaft", {0, 1}, k, c); }
  // The twist that is left of 1 rad.
  double ringing(double time_s) const {
    return std::exp(-decay * time_s) *
           (std::cos(omega * time_s) + decay / omega * std::sin(omega * time_s));
  }
};

}  // namespace

SCENARIO("a damped oscillator is stepped exactly, however long the step", "[sim][plant]") {
  const Flywheels wheels;
  const Eigen::Vector2d& inertia = wheels.inertia;
  const double step_s = GENERATE(1e-4, 0.07, 0.3);  // the last is three periods
  GIVEN("two flywheels on a shaft that was wound up by 1 rad and let go") {
    auto plant = plant_of(inertia, step_s, wheels.shaft());
    plant.shift(Eigen::Vector2d(1, 0));
    THEN("they swing as the closed form says, and their centre stays") {
      for (int i = 1; i <= 10; ++i) {
        plant.step();
        CHECK(plant.state().q[0] - plant.state().q[1] ==
              Approx(wheels.ringing(i * step_s)).margin(1e-11));
        CHECK(inertia.dot(plant.state().v) == Approx(0).margin(1e-11));
        CHECK(inertia.dot(plant.state().q) == Approx(0.02).epsilon(1e-11));
      }
    }
  }
  GIVEN("the same flywheels at rest, under a constant torque") {
    auto plant = plant_of(inertia, step_s, wheels.shaft(), Push(2));
    THEN("they speed up together, and the twist rings about its static value") {
      const double settled = 2 * wheels.reduced / 0.02 / wheels.k;
      for (int i = 1; i <= 10; ++i) {
        plant.step();
        CHECK(plant.state().q[0] - plant.state().q[1] ==
              Approx(settled * (1 - wheels.ringing(i * step_s))).margin(1e-11));
        CHECK(inertia.dot(plant.state().v) == Approx(2 * i * step_s).epsilon(1e-11));
      }
    }
  }
}

TEST_CASE("a force that depends on the state converges with the square of the step",
          "[sim][plant]") {
  // A push against a fan: v = v∞·tanh(t/T), v∞ = √(F/c), T = M/√(F·c).
  const auto error = [](double step_s) {
    auto plant = plant_of(Eigen::VectorXd::Constant(1, 0.5), step_s, Push(2), Fan(0.5));
    const auto steps = std::lround(0.4 / step_s);
    for (long i = 0; i < steps; ++i) plant.step();
    return plant.state().v[0] - 2 * std::tanh(0.4 / 0.5);
  };
  const double coarse = error(0.01), middle = error(0.005), fine = error(0.0025);
  CHECK(std::abs(fine) > 1e-9);  // there is something to converge
  CHECK(coarse / middle == Approx(4).epsilon(0.1));
  CHECK(middle / fine == Approx(4).epsilon(0.05));
}

TEST_CASE("the plant's energy is that of its flywheels", "[sim][plant]") {
  auto plant = plant_of(Eigen::Vector2d(0.02, 0.03), 0.01, Push(2));
  for (int i = 0; i < 100; ++i) plant.step();
  CHECK(plant.kinetic_energy_J() == Approx(0.5 * 0.02 * 100 * 100));  // v = F·t/M
}

TEST_CASE("a plant that nobody pushes stays where it is", "[sim][plant]") {
  auto plant = plant_of(Eigen::Vector2d(0.02, 0.03), 0.01,
                        sim::LinearAxisTerm("shaft", {0, 1}, 50, 1), Fan(0.5));
  for (int i = 0; i < 100; ++i) plant.step();
  CHECK(plant.state().q.norm() == 0);
  CHECK(plant.state().v.norm() == 0);
}

TEST_CASE("a plant refuses bodies without inertia and time without steps", "[sim][plant]") {
  CHECK_THROWS_AS(plant_of(Eigen::Vector2d(0.02, 0), 0.01, Push(1)), std::invalid_argument);
  CHECK_THROWS_AS(plant_of(Eigen::Vector2d(0.02, NAN), 0.01, Push(1)), std::invalid_argument);
  CHECK_THROWS_AS(plant_of(Eigen::Vector2d(0.02, 0.03), 0, Push(1)), std::invalid_argument);
}
