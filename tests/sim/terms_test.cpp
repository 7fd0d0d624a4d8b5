#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "hal/types/units.hpp"
#include "sim/terms/cycloid_stage.hpp"
#include "sim/terms/friction.hpp"
#include "sim/terms/induction_motor.hpp"
#include "sim/terms/planet_mesh.hpp"
#include "sim/terms/shaft_torsion.hpp"
#include "tests/sim/term_laws.hpp"

using namespace rvbench;
using units::two_pi;

namespace {

constexpr Eigen::Index bodies = 4;

sim::ShaftTorsion::Params shaft() {
  return {.body_a = 0, .body_b = 2, .stiffness_Nm_rad = 600, .damping_Nms_rad = 0.5};
}

sim::Friction::Params friction() {
  return {.body = 1, .coulomb_Nm = 0.15, .viscous_Nms_rad = 5e-4, .creep_speed_rad_s = 2};
}

sim::PlanetMesh::Params mesh() {
  return {.sun = 1,
          .carrier = 3,
          .planet = 2,
          .place_rad = 1.1,
          .sun_base_radius_m = 5.3e-3,
          .planet_base_radius_m = 15.9e-3,
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

}  // namespace

TEST_CASE("every term adds its force, and its linear part and remainder make the whole",
          "[sim][terms][law]") {
  const auto s = test::some_state(bodies, GENERATE(1, 2, 3, 4, 5));
  sim::InductionMotor running(motor());
  running.set_supply(40, true);
  running.advance(1e-3);
  test::check_plumbing(sim::ShaftTorsion(shaft()), s);
  test::check_plumbing(sim::Friction(friction()), s);
  test::check_plumbing(sim::PlanetMesh(uneven_mesh()), s);
  test::check_plumbing(sim::CycloidStage(uneven_stage()), s);
  test::check_plumbing(running, s);
}

TEST_CASE("every term balances its energy book", "[sim][terms][law]") {
  const auto s = test::some_state(bodies, GENERATE(11, 12, 13, 14, 15));
  sim::InductionMotor running(motor());
  running.set_supply(40, true);
  running.advance(1e-3);
  test::check_energy_book(sim::ShaftTorsion(shaft()), s);
  test::check_energy_book(sim::Friction(friction()), s);
  test::check_energy_book(sim::PlanetMesh(mesh()), s);
  test::check_energy_book(sim::CycloidStage(stage()), s);
  CHECK(test::force_of(running, s).dot(s.v) == Approx(running.supplied_power_W(s)));
}

TEST_CASE("a shaft twists both its ends, equally and oppositely", "[sim][terms][law]") {
  const auto f = test::force_of(sim::ShaftTorsion(shaft()), test::some_state(bodies, 3));
  CHECK(f.sum() == Approx(0).margin(1e-9));
  CHECK(f[1] == 0);
  CHECK(f[3] == 0);
  const auto twisted = test::force_of(sim::ShaftTorsion(shaft()), turned(0, 0.01));
  CHECK(twisted[0] == Approx(-6));
  CHECK(sim::ShaftTorsion(shaft()).torque_Nm(turned(0, 0.01)) == Approx(6));
}

TEST_CASE("friction opposes motion and saturates at Coulomb's torque", "[sim][terms][law]") {
  const sim::Friction term(friction());
  auto s = turned(1, 0);
  CHECK(test::force_of(term, s).norm() == 0);
  s.v[1] = 100;
  CHECK(test::force_of(term, s)[1] == Approx(-(0.15 + 100 * 5e-4)));
  s.v[1] = -100;
  CHECK(test::force_of(term, s)[1] == Approx(0.15 + 100 * 5e-4));
  s.v[1] = 0.01;  // it creeps: slope T_c / v_ε
  CHECK(test::force_of(term, s)[1] == Approx(-0.01 * (0.15 / 2 + 5e-4)).epsilon(1e-4));
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
  CHECK(term.torque_Nm(10) == 0);  // not switched on
  term.set_supply(50, true);
  CHECK(term.torque_Nm(nominal_rad_s) == Approx(0).margin(1e-12));
  CHECK(term.torque_Nm(nominal_rad_s * (1 - 0.15)) == Approx(12));   // pull-out
  CHECK(term.torque_Nm(nominal_rad_s * (1 + 0.15)) == Approx(-12));  // generator
  CHECK(term.torque_Nm(nominal_rad_s * (1 - 0.14)) < 12);
  CHECK(term.torque_Nm(nominal_rad_s * (1 - 0.16)) < 12);
  // Locked rotor, slip 1: 2·12 / (1/0.15 + 0.15)
  CHECK(term.torque_Nm(0) == Approx(24 / (1 / 0.15 + 0.15)));
  WHEN("the inverter runs at half the frequency") {
    term.set_supply(25, true);
    THEN("the same slip speed gives the same torque") {
      CHECK(term.torque_Nm(nominal_rad_s * (0.5 - 0.03)) ==
            Approx(24 / (0.15 / 0.03 + 0.03 / 0.15)));
    }
  }
  WHEN("it is switched off") {
    term.set_supply(50, false);
    CHECK(term.torque_Nm(0) == 0);
  }
}

TEST_CASE("the inverter's ripple beats six times per electrical turn", "[sim][terms]") {
  sim::InductionMotor term(motor());
  term.set_supply(40, true);
  constexpr int n = 960;
  double mean = 0, cosine = 0, others = 0;
  for (int i = 1; i <= n; ++i) {  // one electrical turn
    term.advance(1.0 / 40 / n);
    const double torque = term.torque_Nm(100) / n;
    mean += torque;
    cosine += 2 * torque * std::cos(6 * two_pi * i / n);
    others += 2 * torque * std::cos(5 * two_pi * i / n);
  }
  CHECK(cosine / mean == Approx(0.02));
  CHECK(others / mean == Approx(0).margin(1e-12));
}

TEST_CASE("a term refuses parameters that make no physical sense", "[sim][terms]") {
  const auto refused = [](auto make, auto params, auto spoil) {
    spoil(params);
    CHECK_THROWS_AS(make(params), std::invalid_argument);
  };
  const auto a_shaft = [](const auto& p) { return sim::ShaftTorsion(p); };
  refused(a_shaft, shaft(), [](auto& p) { p.stiffness_Nm_rad = -1; });
  refused(a_shaft, shaft(), [](auto& p) { p.damping_Nms_rad = NAN; });
  const auto a_friction = [](const auto& p) { return sim::Friction(p); };
  refused(a_friction, friction(), [](auto& p) { p.coulomb_Nm = -1; });
  refused(a_friction, friction(), [](auto& p) { p.viscous_Nms_rad = -1; });
  refused(a_friction, friction(), [](auto& p) { p.creep_speed_rad_s = 0; });
  const auto a_mesh = [](const auto& p) { return sim::PlanetMesh(p); };
  refused(a_mesh, mesh(), [](auto& p) { p.sun_base_radius_m = 0; });
  refused(a_mesh, mesh(), [](auto& p) { p.planet_base_radius_m = -1; });
  refused(a_mesh, mesh(), [](auto& p) { p.stiffness_N_m = 0; });
  refused(a_mesh, mesh(), [](auto& p) { p.damping_Ns_m = -1; });
  const auto a_stage = [](const auto& p) { return sim::CycloidStage(p); };
  refused(a_stage, stage(), [](auto& p) { p.pins = 0; });
  refused(a_stage, stage(), [](auto& p) { p.stiffness_Nm_rad = 0; });
  refused(a_stage, stage(), [](auto& p) { p.damping_Nms_rad = NAN; });
  const auto a_motor = [](const auto& p) { return sim::InductionMotor(p); };
  refused(a_motor, motor(), [](auto& p) { p.pole_pairs = 0; });
  refused(a_motor, motor(), [](auto& p) { p.pull_out_torque_Nm = 0; });
  refused(a_motor, motor(), [](auto& p) { p.pull_out_slip = 0; });
  refused(a_motor, motor(), [](auto& p) { p.nominal_frequency_Hz = 0; });
  refused(a_motor, motor(), [](auto& p) { p.ripple = -1; });
}
