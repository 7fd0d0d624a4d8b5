#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "sim/plant_check.hpp"
#include "sim/plant_model.hpp"
#include "sim/term_memory.hpp"
#include "tests/sim/drive_runs.hpp"
#include "tests/support/under_sanitizer.hpp"

// What motor, inverter and brake of the RV-20E's bench add to what its gears do.

using namespace rvbench;
using namespace rvbench::test;

TEST_CASE("each has its one place on the bench, and none on a slide or an oscillator",
          "[sim][effects]") {
  const sim::PlantSpec bench = sim::rv20e_bench();
  const auto place = [&](const std::string& effect) {
    REQUIRE(sites(bench, effect).size() == 1);
    return describe(sites(bench, effect)[0]);
  };
  CHECK(place("rotor_bar") == "motor against the housing, by motor_torque");
  CHECK(place("speed_modulation") == "motor against the housing, by motor_torque");
  CHECK(place("brake_ripple") == "brake against the housing, by brake_torque");
  for (const std::string effect : {"rotor_bar", "speed_modulation", "brake_ripple"}) {
    for (const std::string other : {"emps", "silverbox", "ur10e_joint", "oedi_gearbox"}) {
      INFO(effect << " on " << other);
      CHECK(sites(shipped(other), effect).empty());
    }
  }
  CHECK(sites(with_rotor_bar(0.02), "rotor_bar").empty());  // not twice
}

TEST_CASE("what they refer to is a motor that acts there, or an input that pushes there",
          "[sim][effects]") {
  const auto fault_of = [](sim::PlantSpec plant, const std::string& reference) {
    plant.terms.back().reference = reference;
    const auto faults = sim::check_plant(plant);
    return faults.empty() ? "" : faults.front().pointer + ": " + faults.front().message;
  };
  CHECK(fault_of(with_rotor_bar(0.02), "motor_torque").empty());
  CHECK(fault_of(with_rotor_bar(0.02), "coupling") ==
        "/terms/10/motor: \"coupling\" is a shaft_torsion, rotor_bar asks for an induction_motor");
  CHECK(fault_of(with_brake_ripple(0.02, 1), "supply") ==
        "/terms/10/brake: \"supply\" does not push \"brake\"");
}

SCENARIO("a broken bar modulates the torque once for each of its poles that the field passes",
         "[sim][effects]") {
  const auto model = std::get<0>(sim::make_model(with_rotor_bar(0.03)));
  const sim::PhysicsTerm& bar = *model.terms.back();
  // 1770 rpm at 60 Hz: the field runs past the rotor at 1 Hz, electrically.
  sim::PlantState s{Eigen::VectorXd::Zero(6), Eigen::VectorXd::Zero(6),
                    Eigen::VectorXd::Zero(model.memory_size), Eigen::Vector2d(supply_Hz, -brake_Nm),
                    0};
  s.v[0] = 1770 * two_pi / 60;
  const double x = (two_pi * 30 - s.v[0]) / (two_pi * 25 * 0.15);
  const double kloss_Nm = 2 * 12 * x / (1 + x * x);
  Eigen::VectorXd rates = Eigen::VectorXd::Zero(model.memory_size);
  dynamic_cast<const sim::TermMemory&>(bar).add_rates(s, rates);
  constexpr int n = 200;  // of one second
  const auto line = [&](int frequency_Hz) {
    Complex sum = 0;
    for (int i = 0; i < n; ++i) {
      s.z = rates * i / n;
      sum -= bar.effort(s) * std::polar(2.0 / n, -two_pi * frequency_Hz * i / n);
    }
    return sum;
  };
  THEN("it is a line of its share of the torque at twice the slip frequency, and no other") {
    CHECK(bar.rhythm_Hz(s) == Approx(2));
    CHECK(std::abs(line(2) - std::polar(0.03 * kloss_Nm, 0.7)) < 1e-9);
    for (const int other : {0, 1, 3, 4, 6, 60, 62}) CHECK(std::abs(line(other)) < 1e-9);
  }
  THEN("a rotor as fast as the field feels nothing") {
    s.v[0] = two_pi * 30;
    CHECK(bar.rhythm_Hz(s) == Approx(0).margin(1e-9));
    CHECK(bar.effort(s) == Approx(0).margin(1e-9));
  }
}

// A constant load holds nothing against a slow swing: the bodies turn with it all together, held by
// the motor's own slip, and hardly any of it is passed on through the transducer.
SCENARIO("a broken bar swings the speed, in time as by orders", "[sim][effects][steady]") {
  if (test::too_long_under_sanitizer()) return;
  const sim::PlantSpec plant =
      sim::with_probes(with_rotor_bar(0.03), "motor", {sim::OutputKind::speed});
  const sim::SteadyState state = steady(plant);
  const double at_Hz = twice_slip_Hz(state);
  const Linearised motor(state);
  const double expected = 0.03 * motor.torque_Nm / std::abs(motor.held(at_Hz));
  CHECK(timed_line(state, at_Hz) == Approx(expected).epsilon(0.01));
  const InTime speed(plant, 8);
  CHECK(speed.line(at_Hz) == Approx(timed_line(state, at_Hz)).epsilon(0.03));
}

SCENARIO("a brake's ripple shows in time as it does by orders", "[sim][effects][steady]") {
  if (test::too_long_under_sanitizer()) return;
  const int per_turn = GENERATE(1, 2);
  const sim::PlantSpec plant = with_brake_ripple(0.03, per_turn);
  const sim::SteadyState state = steady(plant);
  const Eigen::VectorXd lines = state.outputs[0].shaft_lines.cwiseAbs();
  // The brake turns every four seconds: its torque is passed on through the gears as it is.
  CHECK(lines[per_turn] == Approx(0.03 * brake_Nm / 121).epsilon(0.1));
  CHECK(lines[3 - per_turn] < 0.05 * lines[per_turn]);
  const InTime torque(plant, 16.4);
  CHECK(torque.line(per_turn * state.period_Hz) == Approx(lines[per_turn]).epsilon(0.03));
}

SCENARIO("a hunting drive shows in time as it does by orders", "[sim][effects][steady]") {
  if (test::too_long_under_sanitizer()) return;
  const sim::PlantSpec plant = with_speed_modulation(0.005);
  const sim::SteadyState state = steady(plant);
  const InTime torque(plant, 8);
  CHECK(torque.line(3) == Approx(timed_line(state, 3)).epsilon(0.03));
  CHECK(torque.line(4.5) < 0.02 * torque.line(3));
}

SCENARIO("a hunting drive swings the motor by its slope over the slip", "[sim][effects][steady]") {
  const auto state =
      steady(sim::with_probes(with_speed_modulation(0.005), "motor", {sim::OutputKind::speed}));
  const Linearised motor(state);
  const double push_Nm = motor.slope_Nms * 0.005 * two_pi * supply_Hz / 2;  // two pole pairs
  CHECK(timed_line(state, 3) == Approx(push_Nm / std::abs(motor.held(3))).epsilon(0.01));
}

// So fast that the inertia of the bodies holds their speed: the slip swings by all that the drive
// hunts by.
SCENARIO("a drive that hunts far slows the motor by the curvature of its torque",
         "[sim][effects][steady]") {
  if (test::too_long_under_sanitizer()) return;
  const auto hunting = [](double depth, double phase_rad) {
    return sim::with_probes(bench_with("speed_modulation", {{"depth", {depth, "1"}},
                                                            {"phase", {phase_rad, "rad"}},
                                                            {"frequency", {300, "Hz"}}}),
                            "motor", {sim::OutputKind::speed});
  };
  const sim::SteadyState still = steady(hunting(0, 0));
  const double slower_rad_s = still.outputs[0].mean - steady(hunting(0.01, 0)).outputs[0].mean;
  const Linearised motor(still);
  const double swing_rad_s = 0.01 * two_pi * supply_Hz / 2;
  const double less_Nm = -motor.curvature_Nms2 * swing_rad_s * swing_rad_s / 4;
  CHECK(slower_rad_s == Approx(less_Nm / std::real(motor.held(0))).epsilon(0.1));
  THEN("whatever the phase") {
    const double phase_rad = GENERATE(0.7, two_pi / 4);
    const double other_rad_s =
        still.outputs[0].mean - steady(hunting(0.01, phase_rad)).outputs[0].mean;
    CHECK(other_rad_s == Approx(slower_rad_s).epsilon(0.02));
  }
  THEN("in time too") {
    const InTime without(hunting(0, 0), 8), with(hunting(0.01, 0), 8);
    CHECK(without.mean() - with.mean() == Approx(slower_rad_s).epsilon(0.1));
  }
}

SCENARIO("a broken bar and a brake's ripple grow with the load, a hunting drive hardly",
         "[sim][effects][steady]") {
  const auto bar = [](double load_Nm) {
    const sim::PlantSpec plant =
        sim::with_probes(with_rotor_bar(0.03), "motor", {sim::OutputKind::speed});
    const sim::SteadyState state = steady(plant, load_Nm);
    return timed_line(state, twice_slip_Hz(state));
  };
  const double torque_ratio = steady(sim::rv20e_bench(), 150).outputs[0].mean /
                              steady(sim::rv20e_bench(), 75).outputs[0].mean;
  CHECK(torque_ratio > 1.6);
  CHECK(bar(150) == Approx(torque_ratio * bar(75)).epsilon(0.05));
  const auto ripple = [](double load_Nm) {
    return std::abs(steady(with_brake_ripple(0.03, 1), load_Nm).outputs[0].shaft_lines[1]);
  };
  CHECK(ripple(150) == Approx(2 * ripple(75)).epsilon(0.02));
  CHECK(ripple(0) < 1e-9);
  const auto hunting = [](double load_Nm) {
    return timed_line(steady(with_speed_modulation(0.005), load_Nm), 3);
  };
  CHECK(hunting(150) == Approx(hunting(75)).epsilon(0.1));
}

SCENARIO("of no size they change nothing", "[sim][effects][steady]") {
  const sim::SteadyState bare = steady(sim::rv20e_bench());
  for (const sim::PlantSpec& plant :
       {with_rotor_bar(0), with_brake_ripple(0, 1), with_speed_modulation(0)}) {
    INFO(plant.terms.back().name);
    const sim::SteadyState state = steady(plant);
    CHECK(state.outputs[0].mean == Approx(bare.outputs[0].mean).epsilon(1e-9));
    for (const int order : {1, 2, 1080}) {
      CHECK(std::abs(std::abs(state.outputs[0].shaft_lines[order]) -
                     std::abs(bare.outputs[0].shaft_lines[order])) < 1e-8);
    }
  }
  const sim::SteadyState bar = steady(with_rotor_bar(0));
  CHECK(timed_line(bar, twice_slip_Hz(bar)) < 1e-12);
  CHECK(timed_line(steady(with_speed_modulation(0)), 3) < 1e-12);
}
