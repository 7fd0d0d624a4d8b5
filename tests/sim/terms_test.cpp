#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

#include "hal/types/units.hpp"
#include "sim/terms/cycloid_stage.hpp"
#include "sim/terms/induction_motor.hpp"
#include "sim/terms/planet_mesh.hpp"
#include "tests/sim/term_laws.hpp"

using namespace rvbench;
using units::two_pi;

namespace {

constexpr Eigen::Index bodies = 4;

sim::PlanetMesh::Params mesh() {
  return {.sun = 1,
          .carrier = 3,
          .planet = 2,
          .place_rad = 1.1,
          .sun_base_radius_m = 5.3e-3,
          .planet_base_radius_m = 15.9e-3,
          .sun_teeth = 9,
          .stiffness_N_m = 8e7,
          .damping_Ns_m = 1000,
          .sun_error_m = {},
          .planet_error_m = {},
          .stiffness_ripple = {}};
}

sim::CycloidStage::Params stage() {
  return {.crank = 2,
          .carrier = 3,
          .pins = 40,
          .pin_circle_radius_m = 52e-3,
          .stiffness_Nm_rad = 84e3,
          .damping_Nms_rad = 40,
          .error_rad = {}};
}

sim::InductionMotor::Params motor() {
  return {.body = 0, .pull_out_torque_Nm = 12, .pull_out_slip = 0.15, .ripple = 0.02};
}

sim::PlanetMesh::Params uneven_mesh() {
  sim::PlanetMesh::Params p = mesh();
  p.sun_error_m.add_cosine(9, 3e-6, 0.4);
  p.planet_error_m.add_cosine(1, 5e-6, 0.2).add_bump(1, 0.1, -40e-6);
  p.stiffness_ripple.add_cosine(9, 0.08, 1);
  return p;
}

sim::CycloidStage::Params uneven_stage() {
  sim::CycloidStage::Params p = stage();
  p.error_rad.add_cosine(1, 4e-5, 0.3).add_cosine(40, 2e-5, 0.1);
  return p;
}

// A state in which only the angle of one body differs from 0.
sim::PlantState turned(Eigen::Index body, double angle_rad) {
  sim::PlantState s{Eigen::VectorXd::Zero(bodies), Eigen::VectorXd::Zero(bodies)};
  s.q[body] = angle_rad;
  return s;
}

// The state under a supply of this frequency, its electrical angle at `electrical_rad`.
sim::PlantState supplied(sim::PlantState s, double frequency_Hz, double electrical_rad = 0.3) {
  s.u = Eigen::VectorXd::Constant(1, frequency_Hz);
  s.z = Eigen::VectorXd::Constant(1, electrical_rad);
  return s;
}

// The motor's torque at a speed.
double torque_Nm(const sim::InductionMotor& term, double frequency_Hz, double speed_rad_s,
                 double electrical_rad = 0) {
  sim::PlantState s = supplied(turned(0, 0), frequency_Hz, electrical_rad);
  s.v[0] = speed_rad_s;
  return term.torque_Nm(s);
}

}  // namespace

TEST_CASE("every term adds its force, and its linear part and remainder make the whole",
          "[sim][terms][law]") {
  const auto s = supplied(test::some_state(bodies, GENERATE(1u, 2u, 3u, 4u, 5u)), 40);
  test::check_plumbing(sim::PlanetMesh(uneven_mesh()), s);
  test::check_plumbing(sim::CycloidStage(uneven_stage()), s);
  test::check_plumbing(sim::InductionMotor(motor()), s);
}

TEST_CASE("every term balances its energy book", "[sim][terms][law]") {
  const auto s = supplied(test::some_state(bodies, GENERATE(11u, 12u, 13u, 14u, 15u)), 40);
  test::check_energy_book(sim::PlanetMesh(mesh()), s);
  test::check_energy_book(sim::CycloidStage(stage()), s);
  const sim::InductionMotor running(motor());
  CHECK(test::force_of(running, s).dot(s.v) == Approx(running.supplied_power_W(s)));
}

SCENARIO("a planet mesh presses along its line of action", "[sim][terms][law]") {
  const sim::PlanetMesh term(mesh());
  WHEN("the sun is turned by a milliradian against everything else") {
    const auto s = turned(1, 1e-3);
    THEN("the force is stiffness times the way on the base circle") {
      CHECK(term.force_N(s) == Approx(8e7 * 5.3e-6));
      const auto f = test::force_of(term, s);
      CHECK(f[1] == Approx(-5.3e-3 * 424));
      CHECK(f[2] == Approx(15.9e-3 * 424));
      CHECK(f[1] + f[3] == Approx(0).margin(1e-12));  // the carrier carries the reaction
    }
  }
  WHEN("sun and planet roll on each other, three turns to one") {
    auto s = turned(1, 3);
    s.q[2] = 1;
    CHECK(term.force_N(s) == Approx(0).margin(1e-6));
  }
  WHEN("the train turns as one piece") {
    auto s = turned(1, 0.7);
    s.q[3] = 0.7;
    CHECK(term.force_N(s) == Approx(0).margin(1e-6));
  }
  WHEN("the sun has an error of 3 µm on each of its nine teeth") {
    sim::PlanetMesh::Params p = mesh();
    p.sun_error_m.add_cosine(9, 3e-6, 0);
    const sim::PlanetMesh uneven(p);
    auto s = turned(1, 0);
    s.q[1] = s.q[3] + p.place_rad;  // the tooth's crest is in mesh
    s.q[2] = p.place_rad / 3;
    CHECK(uneven.force_N(s) == Approx(8e7 * 3e-6));
    s.q[1] += two_pi / 18;  // half a tooth on, the gap is
    s.q[2] += two_pi / 54;
    CHECK(uneven.force_N(s) == Approx(-8e7 * 3e-6));
  }
}

SCENARIO("a cycloid stage trades the crank's way for the carrier's torque", "[sim][terms][law]") {
  const sim::CycloidStage term(stage());
  const auto s = test::some_state(bodies, 4);
  const auto f = test::force_of(term, s);
  CHECK(f[3] == Approx(-40 * f[2]));
  CHECK(f[3] == Approx(term.torque_Nm(s)));
  WHEN("the crank makes forty turns against the carrier to one of the carrier") {
    auto rolled = turned(2, 40 * 0.3);
    rolled.q[3] = 0.3;
    THEN("nothing is strained, and it has orbited 39 times in the housing") {
      CHECK(term.torque_Nm(rolled) == Approx(0).margin(1e-6));
      CHECK(term.orbit_angle_rad(rolled) == Approx(39 * 0.3));
    }
  }
  WHEN("one pin lobe is 10 µrad high") {
    sim::CycloidStage::Params p = stage();
    p.error_rad.add_cosine(40, 1e-5, 0);
    CHECK(sim::CycloidStage(p).torque_Nm(turned(2, 0)) == Approx(0.84));
  }
}

SCENARIO("an asynchronous motor follows Kloss", "[sim][terms][literature]") {
  sim::InductionMotor::Params p = motor();
  p.ripple = 0;
  sim::InductionMotor term(p);
  const double nominal_rad_s = two_pi * 50 / 2;
  CHECK(torque_Nm(term, 50, nominal_rad_s) == Approx(0).margin(1e-12));
  CHECK(torque_Nm(term, 50, nominal_rad_s * (1 - 0.15)) == Approx(12));   // pull-out
  CHECK(torque_Nm(term, 50, nominal_rad_s * (1 + 0.15)) == Approx(-12));  // generator
  CHECK(torque_Nm(term, 50, nominal_rad_s * (1 - 0.14)) < 12);
  CHECK(torque_Nm(term, 50, nominal_rad_s * (1 - 0.16)) < 12);
  // Locked rotor, slip 1: 2·12 / (1/0.15 + 0.15)
  CHECK(torque_Nm(term, 50, 0) == Approx(24 / (1 / 0.15 + 0.15)));
  WHEN("the inverter runs at half the frequency") {
    THEN("the same slip speed gives the same torque") {
      CHECK(torque_Nm(term, 25, nominal_rad_s * (0.5 - 0.03)) ==
            Approx(24 / (0.15 / 0.03 + 0.03 / 0.15)));
    }
  }
  WHEN("it is switched off") {
    term.switch_on(false);
    CHECK(torque_Nm(term, 50, 0) == 0);
  }
}

// The sun makes 120 turns against the carrier and the planet 40 while the carrier makes one: with
// radii of 1 to 3 the teeth stay pressed alike; a crank makes 40 as the stage's 40 pins want it.
TEST_CASE("gears push alike as often as they say in one turn of the carrier", "[sim][terms]") {
  const auto changed_by = [](const sim::PhysicsTerm& term, const Eigen::Vector4d& turns,
                             double part) {
    sim::PlantState s = turned(0, 1e-6);
    double most = 0;
    const auto force = [&] {
      Eigen::VectorXd f = Eigen::VectorXd::Zero(bodies);
      term.add_force(s, f);
      return f;
    };
    constexpr int angles = 9720;  // 9 to each tooth of the sun that passes
    for (int angle = 0; angle < angles; ++angle) {
      s.q = two_pi * turns * angle / angles;
      const Eigen::VectorXd before = force();
      s.q += two_pi * part * turns;
      most = std::max(most, (force() - before).norm());
    }
    return most;
  };
  const auto check = [&](const sim::PhysicsTerm& term, const Eigen::Vector4d& turns, int repeats) {
    std::set<int> orders;
    term.add_orders(turns, orders);
    CHECK(std::accumulate(orders.begin(), orders.end(), 0, std::gcd<int, int>) == repeats);
    const double whole = changed_by(term, turns, 0.5 / repeats);
    CHECK(whole > 1e-3);
    CHECK(changed_by(term, turns, 1.0 / repeats) < 1e-3 * whole);
  };
  Eigen::Vector4d turns = Eigen::Vector4d::Zero();
  sim::PlanetMesh::Params gears = mesh();
  gears.planet_base_radius_m = 3 * gears.sun_base_radius_m;
  turns[gears.sun] = 121;
  turns[gears.carrier] = 1;
  turns[gears.planet] = 40;
  gears.sun_error_m.add_cosine(9, 3e-6, 0.4);
  check(sim::PlanetMesh(gears), turns, 1080);
  gears.sun_error_m.add_cosine(1, 3e-6, 0.4);
  check(sim::PlanetMesh(gears), turns, 120);
  gears.planet_error_m.add_bump(1, 0.1, -40e-6);
  check(sim::PlanetMesh(gears), turns, 40);

  turns = Eigen::Vector4d::Zero();
  sim::CycloidStage::Params cranks = stage();
  turns[cranks.crank] = 40;
  turns[cranks.carrier] = 1;
  cranks.error_rad.add_cosine(40, 2e-5, 0.1);
  check(sim::CycloidStage(cranks), turns, 1560);
  cranks.error_rad.add_cosine(1, 2e-5, 0.1);
  check(sim::CycloidStage(cranks), turns, 39);
}

TEST_CASE("the inverter's ripple beats six times per electrical turn", "[sim][terms]") {
  const sim::InductionMotor term(motor());
  constexpr int n = 960;
  double mean = 0, cosine = 0, others = 0;
  for (int i = 1; i <= n; ++i) {
    const double electrical_rad = two_pi * i / n;
    const double torque = torque_Nm(term, 40, 100, electrical_rad) / n;
    mean += torque;
    cosine += 2 * torque * std::cos(6 * electrical_rad);
    others += 2 * torque * std::cos(5 * electrical_rad);
  }
  CHECK(cosine / mean == Approx(0.02));
  CHECK(others / mean == Approx(0).margin(1e-12));
  Eigen::VectorXd rates =
      Eigen::VectorXd::Zero(1);  // and the angle turns at the supply's frequency
  term.add_rates(supplied(turned(0, 0), 40), rates);
  CHECK(rates[0] == Approx(two_pi * 40));
}

TEST_CASE("a term refuses parameters that make no physical sense", "[sim][terms]") {
  const auto refused = [](auto make, auto params, auto spoil) {
    spoil(params);
    CHECK_THROWS_AS(make(params), std::invalid_argument);
  };
  const auto a_mesh = [](const auto& p) { return sim::PlanetMesh(p); };
  refused(a_mesh, mesh(), [](auto& p) { p.sun_base_radius_m = 0; });
  refused(a_mesh, mesh(), [](auto& p) { p.planet_base_radius_m = -1; });
  refused(a_mesh, mesh(), [](auto& p) { p.stiffness_N_m = 0; });
  refused(a_mesh, mesh(), [](auto& p) { p.damping_Ns_m = -1; });
  refused(a_mesh, mesh(), [](auto& p) { p.sun_teeth = 9.5; });
  const auto a_stage = [](const auto& p) { return sim::CycloidStage(p); };
  refused(a_stage, stage(), [](auto& p) { p.pins = 0; });
  refused(a_stage, stage(), [](auto& p) { p.pins = 39.5; });
  refused(a_stage, stage(), [](auto& p) { p.pin_circle_radius_m = 0; });
  refused(a_stage, stage(), [](auto& p) { p.stiffness_Nm_rad = 0; });
  refused(a_stage, stage(), [](auto& p) { p.damping_Nms_rad = NAN; });
  const auto a_motor = [](const auto& p) { return sim::InductionMotor(p); };
  refused(a_motor, motor(), [](auto& p) { p.pole_pairs = 0; });
  refused(a_motor, motor(), [](auto& p) { p.pole_pairs = 1.5; });
  refused(a_motor, motor(), [](auto& p) { p.pull_out_torque_Nm = 0; });
  refused(a_motor, motor(), [](auto& p) { p.pull_out_slip = 0; });
  refused(a_motor, motor(), [](auto& p) { p.nominal_frequency_Hz = 0; });
  refused(a_motor, motor(), [](auto& p) { p.ripple = -1; });
}
