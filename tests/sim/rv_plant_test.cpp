#include "sim/rv_plant.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "hal/types/linear_algebra.hpp"
#include "sim/rv_bench.hpp"
#include "tests/sim/plant_texts.hpp"
#include "tests/sim/rv_train.hpp"

using namespace rvbench;
using Complex = std::complex<double>;

namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double mesh_order = 1080.0 / 121, pin_order = 1560.0 / 121;

// The drawing without what makes it uneven: no ripple of motor or teeth.
sim::PlantSpec even_bench() { return test::rv_plant({.supply_Hz = 1}); }

sim::PlantSpec with(sim::PlantSpec plant, const std::string& term, const std::string& parameter,
                    double value) {
  for (sim::TermSpec& t : plant.terms) {
    if (t.name == term) t.parameters.at(parameter).value = value;
  }
  return plant;
}

// As the file says it is done: one more body, the places apart, a third of the stiffness each.
sim::PlantSpec with_three_planets(sim::PlantSpec plant) {
  plant.bodies.push_back(*plant.find_body("planet_2"));
  plant.bodies.back().name = "planet_3";
  for (const char* name : {"mesh_", "stage_"}) {
    sim::TermSpec third = *plant.find_term(std::string(name) + "2");
    third.name = std::string(name) + "3";
    (third.body_b == "carrier" ? third.body_a : third.body_b) = "planet_3";
    plant.terms.push_back(third);
  }
  for (sim::TermSpec& term : plant.terms) {
    const int planet = term.name.back() - '1';
    if (term.type == "planet_mesh") term.parameters.at("place").value = two_pi * planet / 3;
    if (term.type == "cycloid_stage") {
      term.parameters.at("stiffness").value *= 2.0 / 3;
      term.parameters.at("damping").value *= 2.0 / 3;
    }
  }
  return plant;
}

struct Steady {
  double speed_rad_s, torque_Nm;
};

// Kloss's formula and the losses: what the input comes to under a brake torque.
Steady closed_form(double supply_Hz, double brake_Nm) {
  const double sync_rad_s = two_pi * supply_Hz / 2, nominal_rad_s = two_pi * 25;
  Steady steady{sync_rad_s, 0};
  for (int i = 0; i < 100; ++i) {
    steady.torque_Nm =
        (brake_Nm + 0.5 * steady.speed_rad_s / 121) / 121 + 0.15 + 5e-4 * steady.speed_rad_s;
    const double share = steady.torque_Nm / 12;
    const double slip = 0.15 * (1 - std::sqrt(1 - share * share)) / share;
    steady.speed_rad_s = sync_rad_s - slip * nominal_rad_s;
  }
  return steady;
}

double coupling_Nm(const sim::Plant& plant) {
  for (const auto& term : plant.terms()) {
    if (term->name() == "shaft_torsion") return term->effort(plant.state());
  }
  return NAN;
}

// Amplitude of the input torque at orders of the input shaft, over one output turn. Of the mean,
// which is taken off, the last step's part would leak.
std::vector<double> lines_Nm(const sim::PlantSpec& plant, const std::vector<double>& orders,
                             double supply_Hz = 20, double brake_Nm = 167) {
  test::SteppedTrain train(plant, supply_Hz, brake_Nm);
  for (int i = 0; i < 3 * 19840; ++i) train.step();
  const double start_rad = train.plant().state().q[1];
  const double start_Nm = coupling_Nm(train.plant());
  std::vector<Complex> sums(orders.size());
  while (train.plant().state().q[1] < start_rad + 121 * two_pi) {
    train.step();
    const sim::PlantState& s = train.plant().state();
    const double turned_rad = s.v[1] * train.plant().step_s();
    for (std::size_t i = 0; i < orders.size(); ++i) {
      sums[i] +=
          (coupling_Nm(train.plant()) - start_Nm) * std::polar(turned_rad, -orders[i] * s.q[1]);
    }
  }
  std::vector<double> amplitudes;
  for (const Complex& sum : sums) amplitudes.push_back(2 * std::abs(sum) / (121 * two_pi));
  return amplitudes;
}

// What a push on the bodies at one frequency does to the coupling's torque, by the bodies'
// equations of motion in the frequency domain.
double answered_Nm(const Eigen::VectorXd& push, double frequency_rad_s) {
  const auto model = std::get<sim::PlantModel>(sim::make_model(even_bench()));
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(6, 6), c = k;
  for (const auto& term : model.terms) term->add_linear(k, c);
  c(0, 0) += 2 * 12 / 0.15 / (two_pi * 25);  // the motor's torque over slip speed
  const Complex j(0, 1);
  Eigen::MatrixXcd dynamic = k.cast<Complex>() + j * frequency_rad_s * c.cast<Complex>();
  dynamic.diagonal() -= (frequency_rad_s * frequency_rad_s * model.inertia).cast<Complex>();
  const Eigen::VectorXcd q =
      algebra::ComplexLu(dynamic).solve(Eigen::VectorXcd(push.cast<Complex>()));
  return std::abs((600.0 + j * frequency_rad_s * 0.05) * (q[0] - q[1]));
}

std::string fault_of(const sim::PlantSpec& plant) {
  std::string all;
  for (const auto& fault : sim::rv_plant_faults(plant)) {
    all += fault.pointer + ": " + fault.message + '\n';
  }
  return all;
}

}  // namespace

SCENARIO("a shaft too stiff for the bench's steps is refused, and turns at finer ones",
         "[sim][rv_plant]") {
  // 2.25 MN·m/rad between the halves of the motor's 2 g·m²: 10.7 kHz.
  const sim::PlantSpec stiff =
      sim::with_effect(sim::rv20e_bench(), "series_compliance", {.body_a = "motor"},
                       {{"stiffness", {2.25e6, "N·m/rad"}},
                        {"damping", {0.004, "N·m·s/rad"}},
                        {"far_share", {0.45, "1"}}});
  CHECK_THAT(fault_of(stiff), Catch::Matchers::Contains("/terms: a mode is too fast"));
  sim::RvUnit even;
  even.phases_rad.assign(10, 0);
  CHECK_THROWS_AS(sim::RvTrain(stiff, even, 1 / sim::rv_step_rate_Hz), std::invalid_argument);
  CHECK(fault_of(sim::rv20e_bench()).empty());
  const auto speed_rad_s = [&](const sim::PlantSpec& plant) {
    constexpr double step_rate_Hz = 2 * sim::rv_step_rate_Hz;
    sim::RvTrain train(plant, even, 1 / step_rate_Hz);
    for (int i = 0; i < int(2 * step_rate_Hz); ++i) {
      train.set_supply(20 * std::min(1.0, i / step_rate_Hz), true);
      train.step();
    }
    return train.state().v[0];
  };
  CHECK(speed_rad_s(stiff) == Approx(speed_rad_s(sim::rv20e_bench())).epsilon(1e-3));
}

SCENARIO("the bench comes to the speed and torque that Kloss and its losses say",
         "[sim][rv_plant][literature]") {
  const double brake_Nm = GENERATE(0.0, 83.5, 250.5);
  const Steady expected = closed_form(40, brake_Nm);
  GIVEN("the plant file, on the stepper of the rig") {
    test::SteppedTrain train(even_bench(), 40, brake_Nm);
    for (int i = 0; i < 4 * 19840; ++i) train.step();
    CHECK(coupling_Nm(train.plant()) == Approx(expected.torque_Nm).epsilon(1e-6));
    CHECK(train.plant().state().v[0] == Approx(expected.speed_rad_s).epsilon(1e-6));
    CHECK(train.plant().state().v[4] == Approx(expected.speed_rad_s / 121).epsilon(1e-6));
  }
  GIVEN("three planets instead of two") {
    test::SteppedTrain train(with_three_planets(even_bench()), 40, brake_Nm);
    for (int i = 0; i < 4 * 19840; ++i) train.step();
    CHECK(coupling_Nm(train.plant()) == Approx(expected.torque_Nm).epsilon(1e-6));
  }
}

TEST_CASE("simulate settles where the closed form says", "[sim][rv_plant][literature]") {
  constexpr double rate_Hz = 496;
  constexpr Eigen::Index samples = 992;
  const auto channels = test::run_of(
      even_bench(),
      {test::channel_of("supply", "Hz", rate_Hz, Eigen::VectorXd::Constant(samples, 40)),
       test::channel_of("brake_torque", "N·m", rate_Hz, Eigen::VectorXd::Constant(samples, 167))});
  const Steady expected = closed_form(40, 167);
  const Channel& torque = *find_channel(channels, "input_torque");
  const Channel& angle = *find_channel(channels, "input_angle");
  CHECK(torque.samples[samples - 1] == Approx(expected.torque_Nm).epsilon(1e-6));
  CHECK((angle.samples[samples - 1] - angle.samples[samples - 2]) * rate_Hz ==
        Approx(expected.speed_rad_s).epsilon(1e-6));
}

SCENARIO(
    "an error of the teeth shows at its line of the torque, as large as the bodies' "
    "equations say",
    "[sim][rv_plant]") {
  const double speed_rad_s = closed_form(20, 167).speed_rad_s;
  constexpr double error_m = 1e-6;
  GIVEN("a bench without errors") {
    for (const double line : lines_Nm(even_bench(), {mesh_order, 2 * mesh_order, pin_order})) {
      CHECK(line < 1e-6);
    }
  }
  GIVEN("a profile error on what one planet sees") {
    const auto lines =
        lines_Nm(with(even_bench(), "mesh_1", "profile_error", error_m), {mesh_order, pin_order});
    Eigen::VectorXd push = Eigen::VectorXd::Zero(6);
    push[1] = -5.3e-3 * 8e7 * error_m;
    push[2] = 15.9e-3 * 8e7 * error_m;
    push[4] = 5.3e-3 * 8e7 * error_m;
    CHECK(lines[0] == Approx(answered_Nm(push, mesh_order * speed_rad_s)).epsilon(0.01));
    CHECK(lines[1] < 1e-3 * lines[0]);
  }
  GIVEN("a pin error under both cranks") {
    const auto plant =
        with(with(even_bench(), "stage_1", "pin_error", error_m), "stage_2", "pin_error", error_m);
    const auto lines = lines_Nm(plant, {pin_order, mesh_order});
    Eigen::VectorXd push = Eigen::VectorXd::Zero(6);
    push[2] = push[3] = -84e3 / 40 * error_m / 52e-3;
    push[4] = 2 * 84e3 * error_m / 52e-3;
    CHECK(lines[0] == Approx(answered_Nm(push, pin_order * speed_rad_s)).epsilon(0.01));
    CHECK(lines[1] < 1e-3 * lines[0]);
  }
}

TEST_CASE("two equal planets cancel the odd mesh harmonics in torque, three keep them",
          "[sim][rv_plant][literature]") {
  auto two = even_bench();
  for (const char* mesh : {"mesh_1", "mesh_2"}) two = with(two, mesh, "profile_error", 1e-6);
  const auto lines = lines_Nm(two, {mesh_order, 2 * mesh_order});
  CHECK(lines[0] < 1e-3 * lines[1]);
  CHECK(lines_Nm(with_three_planets(two), {mesh_order})[0] > 0.1 * lines[1]);
}

TEST_CASE("a unit's deviations become the plant's, and the plant's own stand", "[sim][rv_plant]") {
  sim::RvUnit unit = sim::draw_unit("healthy", 7);
  unit.deviations.mesh_profile_um = 2;
  unit.deviations.planet_bad_tooth_um = 30;
  unit.marked_planet = 1;
  const auto drawing = with(sim::rv20e_bench(), "mesh_2", "profile_error", 5e-6);
  const auto built = sim::as_built(drawing, unit);
  const auto value = [&](const char* term, const char* parameter) {
    return built.find_term(term)->parameters.at(parameter).value;
  };
  CHECK(value("mesh_1", "profile_error") == Approx(2e-6));
  CHECK(value("mesh_2", "profile_error") == 5e-6);
  CHECK(value("mesh_1", "lost_flank") == 0);
  CHECK(value("mesh_2", "lost_flank") == Approx(30e-6));
  CHECK(value("shaft_friction", "level") == Approx(0.15 * unit.friction_factor));
  CHECK(value("shaft_drag", "damping") == Approx(5e-4 * unit.friction_factor));
  CHECK(value("motor_torque", "pull_out_slip") == Approx(0.15 * unit.motor_slip_factor));
  CHECK(value("coupling", "stiffness") == 600);
}

SCENARIO("a plant that the simulated bench cannot run is told what it lacks", "[sim][rv_plant]") {
  CHECK(fault_of(sim::rv20e_bench()).empty());
  CHECK(fault_of(with_three_planets(sim::rv20e_bench())).empty());
  CHECK_THAT(fault_of(std::get<sim::PlantSpec>(sim::read_plant("silverbox"))),
             Catch::Contains("/bodies: the bench needs a body called \"motor\"\n") &&
                 Catch::Contains("/bodies: the bench needs a body called \"brake\"\n") &&
                 Catch::Contains("/inputs/0: the bench has nothing to drive it with\n") &&
                 Catch::Contains("/terms: the bench needs a planet_mesh\n"));
  auto plant = sim::rv20e_bench();
  std::erase_if(plant.terms, [](const auto& term) { return term.name == "stage_2"; });
  CHECK(fault_of(plant) == "/terms: the bench needs a cycloid_stage of \"planet_2\"\n");
  CHECK(fault_of(with(sim::rv20e_bench(), "mesh_1", "sun_teeth", 9.5)) ==
        "/terms/4: planet_mesh: sun_teeth must be a whole number >= 1\n");
  const auto file = hal::ConfigReader::from_text(
      sim::write_plant(with(sim::rv20e_bench(), "mesh_1", "sun_teeth", 9.5)), "plant.json");
  const auto read = sim::parse_plant(file);  // by whatever command
  REQUIRE(read.index() == 1);
  CHECK(std::get<1>(read).front().pointer == "/terms/4");
  CHECK(std::get<1>(read).front().line > 1);
  CHECK_THROWS_WITH(sim::RvTrain(plant, sim::draw_unit("healthy", 1), 1e-4),
                    Catch::Contains("cycloid_stage"));
}

TEST_CASE("the whole bench runs with three planets, from motor to accelerometers",
          "[sim][rv_plant]") {
  sim::RvBench bench(sim::draw_unit("planet_tooth", 3), with_three_planets(sim::rv20e_bench()));
  CHECK(bench.train().meshes().size() == 3);
  CHECK(bench.train().stages().size() == 3);
  CHECK(bench.train().place_rad(2) - bench.train().place_rad(1) == Approx(two_pi / 3));
  bench.set_supply(40, true);
  bench.set_brake_torque(83.5);
  Eigen::VectorXf scan(sim::RvBench::sensors);
  float largest_m_s2 = 0;
  for (int i = 0; i < 2 * 4960; ++i) {
    bench.step(scan);
    largest_m_s2 = std::max(largest_m_s2, scan.cwiseAbs().maxCoeff());
  }
  CHECK(bench.train().output_speed_rad_s() ==
        Approx(bench.train().input_speed_rad_s() / 121).epsilon(0.01));
  CHECK(scan.allFinite());
  CHECK(largest_m_s2 > 0.1);
  CHECK(largest_m_s2 < 100);  // a tenth of the sensors' range
}

SCENARIO("a holding brake holds below its torque, and brakes with it beyond", "[sim][rv_plant]") {
  const auto plant = sim::with_holding_brake(sim::rv20e_bench());
  REQUIRE(sim::rv_plant_faults(plant).empty());
  const double step_s = 1.0 / 19840;
  sim::RvTrain train(plant, sim::draw_unit("healthy", 1), step_s);
  const auto run_for = [&](double length_s) {
    for (int i = 0; i < length_s / step_s; ++i) train.step();
  };
  GIVEN("a brake told more than the motor gives at standstill") {
    train.set_brake_torque(600);
    train.set_supply(1, true);
    run_for(2);
    THEN("the motor winds the reducer up, and the output stands") {
      CHECK(train.input_torque_Nm() * 121 > 200);
      CHECK(std::abs(train.output_speed_rad_s()) < 1e-6);
      CHECK(train.brake_torque_Nm() == Approx(train.input_torque_Nm() * 121).epsilon(0.02));
    }
  }
  GIVEN("one that is overcome") {
    train.set_brake_torque(83.5);
    train.set_supply(40, true);
    run_for(3);
    THEN("it gives its torque, as one that creeps does") {
      sim::RvTrain creeping(sim::rv20e_bench(), sim::draw_unit("healthy", 1), step_s);
      creeping.set_brake_torque(83.5);
      creeping.set_supply(40, true);
      for (int i = 0; i < 3 / step_s; ++i) creeping.step();
      CHECK(train.output_speed_rad_s() == Approx(creeping.output_speed_rad_s()).epsilon(1e-3));
      CHECK(train.brake_torque_Nm() == Approx(creeping.brake_torque_Nm()).epsilon(0.01));
    }
  }
  GIVEN("a brake's torque that no brake is told") {
    auto lost = plant;
    std::erase_if(lost.terms, [](const auto& term) { return term.type == "holding_brake"; });
    const auto faults = sim::rv_plant_faults(lost);
    REQUIRE_FALSE(faults.empty());
    CHECK_THAT(faults.front().message, Catch::Contains("holding_brake"));
  }
}

SCENARIO("the rig's stepper runs what an explanation may add", "[sim][rv_plant]") {
  const auto mean_Nm = [](const sim::PlantSpec& plant) {
    test::SteppedTrain train(plant, 40, 83.5);
    double sum = 0;
    for (int i = 0; i < 2 * 19840; ++i) {
      train.step();
      if (i >= 19840) sum += coupling_Nm(train.plant()) / 19840;
    }
    return sum;
  };
  const double base_Nm = mean_Nm(even_bench());
  GIVEN("dry friction far steeper at standstill than the step resolves") {
    const auto plant =
        sim::with_effect(even_bench(), "coulomb_friction", {.body_a = "input_shaft"},
                         {{"level", {0.2, "N·m"}}, {"creep_speed", {1e-3, "rad/s"}}});
    CHECK(mean_Nm(plant) == Approx(base_Nm + 0.2).epsilon(0.002));
  }
  GIVEN("friction that grows with the load") {
    const auto plant = sim::with_effect(
        even_bench(), "load_friction", {.body_a = "input_shaft", .reference = "coupling"},
        {{"coefficient", {0.1, "1"}}, {"creep_speed", {1e-3, "rad/s"}}});
    CHECK(mean_Nm(plant) == Approx(base_Nm / 0.9).epsilon(0.002));
  }
  GIVEN("viscous friction that warms up, of a rise that takes hours") {
    const auto plant =
        sim::with_effect(even_bench(), "thermal_viscosity", {.body_a = "input_shaft"},
                         {{"damping", {1e-3, "N·m·s/rad"}},
                          {"thermal_resistance", {0.5, "K/W"}},
                          {"time_constant", {1e5, "s"}}});
    CHECK(mean_Nm(plant) - base_Nm ==
          Approx(1e-3 * closed_form(40, 83.5).speed_rad_s).epsilon(0.02));
  }
}
