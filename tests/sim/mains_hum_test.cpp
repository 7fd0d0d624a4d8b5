#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>

#include "sim/effect_sites.hpp"
#include "sim/plant_check.hpp"
#include "sim/steady_state.hpp"
#include "tests/sim/sine_run.hpp"

using namespace rvbench;

namespace {

sim::PlantSpec mass_on_spring() {
  return test::plant_of(test::mass_on(
      R"({"type": "spring", "body_a": "m",
          "parameters": {"stiffness": {"value": 800, "unit": "N/m"}}})"));
}

sim::PlantSpec humming(const sim::PlantSpec& plant, const std::string& channel, double amplitude,
                       const std::string& unit) {
  return sim::with_effect(
      plant, "mains_hum", {.channel = channel},
      {{"amplitude", {amplitude, unit}}, {"phase", {0.7, "rad"}}, {"frequency", {50, "Hz"}}});
}

// Rotor in a drag of 0.02 N·m·s/rad; what the drag takes is seen, and the speed.
sim::PlantSpec turning() {
  return test::plant_of(R"json({"plant": "rotor", "bodies": [
    {"name": "rotor", "motion": "rotation", "inertia": {"value": 0.002, "unit": "kg·m²"}}],
    "terms": [{"type": "viscous_friction", "name": "drag", "body_a": "rotor",
               "parameters": {"damping": {"value": 0.02, "unit": "N·m·s/rad"}}}],
    "inputs": [{"channel": "drive", "unit": "N·m", "is": "force", "body": "rotor"}],
    "outputs": [{"channel": "torque", "unit": "mV", "is": "effort", "term": "drag",
                 "gain": {"value": 5, "unit": "mV/(N·m)"}},
                {"channel": "speed", "unit": "rad/s", "is": "speed", "body": "rotor"}]})json");
}

sim::SteadyState steady(const sim::PlantSpec& plant) {
  const auto made = sim::SteadyPlant::make(plant);
  const auto& solver = std::get<sim::SteadyPlant>(made);
  auto state = solver.under(Eigen::VectorXd::Constant(1, 0.4), solver.orders_up_to(4));
  return std::get<sim::SteadyState>(std::move(state));
}

std::vector<std::string> faults_of(sim::PlantSpec plant, const sim::Hum& hum) {
  plant.outputs[1].hums = {hum};
  std::vector<std::string> pointers;
  for (const auto& fault : sim::check_plant(plant)) pointers.push_back(fault.pointer);
  return pointers;
}

std::vector<std::string> places_in(const sim::PlantSpec& plant) {
  std::vector<std::string> places;
  for (const auto& site : sim::sites_of(plant, *sim::standard_terms().find("mains_hum"))) {
    places.push_back(sim::describe(site));
  }
  return places;
}

std::vector<std::string> places_in(const std::string& plant) {
  return places_in(std::get<sim::PlantSpec>(sim::read_plant(plant)));
}

}  // namespace

SCENARIO("a channel that hums shows a sinusoid more, and no other channel does", "[sim][hum]") {
  const auto quiet = test::run_of(mass_on_spring(), test::sine_of(2));
  const auto shown = test::run_of(humming(mass_on_spring(), "v", 0.25, "m/s"), test::sine_of(2));
  CHECK(shown[0].samples == quiet[0].samples);
  double most = 0;
  for (Eigen::Index i = 0; i < shown[1].samples.size(); ++i) {
    const double t_s = double(i) / test::sine_rate_Hz;
    const double hum = 0.25 * std::cos(2 * std::numbers::pi * 50 * t_s + 0.7);
    most = std::max(most, std::abs(shown[1].samples[i] - quiet[1].samples[i] - hum));
  }
  CHECK(most < 1e-9);
  THEN("without amplitude it is silent") {
    const auto silent = test::run_of(humming(mass_on_spring(), "v", 0, "m/s"), test::sine_of(2));
    CHECK(silent[1].samples == quiet[1].samples);
  }
}

SCENARIO("of what turns steadily a hum is a line in time, in the channel's unit", "[sim][hum]") {
  // 0.4 N·m on the drag is 20 rad/s and 2 mV; the hum is in mV, whatever the transducer's gain.
  const sim::SteadyState state = steady(humming(turning(), "torque", 0.3, "mV"));
  REQUIRE(state.rhythms_Hz == std::vector<double>{50});
  CHECK(std::abs(state.outputs[0].timed_lines[0] - std::polar(0.3, 0.7)) < 1e-12);
  CHECK(std::abs(state.outputs[1].timed_lines[0]) == 0);
  const sim::SteadyState quiet = steady(turning());
  CHECK(quiet.rhythms_Hz.empty());
  CHECK(state.outputs[0].mean == Approx(2));
  CHECK(state.outputs[0].mean == quiet.outputs[0].mean);
  CHECK(state.outputs[0].shaft_lines.tail(4) == quiet.outputs[0].shaft_lines.tail(4));
}

SCENARIO("a channel may hum at the mains' frequency and at twice that", "[sim][hum]") {
  sim::PlantSpec plant = humming(turning(), "torque", 0.3, "mV");
  plant = sim::with_effect(
      plant, "mains_hum", {.channel = "torque"},
      {{"amplitude", {0.1, "mV"}}, {"phase", {-1, "rad"}}, {"frequency", {100, "Hz"}}});
  const sim::SteadyState state = steady(plant);
  REQUIRE(state.rhythms_Hz == std::vector<double>{50, 100});
  CHECK(std::abs(state.outputs[0].timed_lines[1] - std::polar(0.1, -1.0)) < 1e-12);
}

SCENARIO("a hum is read back as it was written", "[sim][hum][json]") {
  sim::PlantSpec plant = humming(turning(), "torque", 0.3, "mV");
  plant.outputs[0].hums[0].amplitude.tolerance_pct = sim::Quantity::free_pct;
  sim::PlantSpec again = test::plant_of(sim::write_plant(plant));
  REQUIRE(again.outputs[0].hums.size() == 1);
  CHECK(again.outputs[1].hums.empty());
  std::map<std::string, sim::Quantity> found;
  for (const auto& placed : sim::quantities(again)) found[placed.pointer] = *placed.quantity;
  const std::string at = "/outputs/0/hums/0/";
  CHECK(found.at(at + "amplitude").value == 0.3);
  CHECK(found.at(at + "amplitude").unit == "mV");
  CHECK(found.at(at + "amplitude").tolerance_pct == sim::Quantity::free_pct);
  CHECK(found.at(at + "phase").value == 0.7);
  CHECK(found.at(at + "frequency").value == 50);
}

SCENARIO("hums that cannot be are refused where they stand", "[sim][hum][json]") {
  const sim::PlantSpec plant = mass_on_spring();
  using Pointers = std::vector<std::string>;
  const std::string at = "/outputs/1/hums/0/";
  CHECK(faults_of(plant, {{0.1, "m/s"}, {0, "rad"}, {50, "Hz"}}).empty());
  CHECK(faults_of(plant, {{-0.1, "m/s"}, {0, "rad"}, {50, "Hz"}}) ==
        Pointers{at + "amplitude/value"});
  CHECK(faults_of(plant, {{0.1, "m"}, {0, "rad"}, {50, "Hz"}}) == Pointers{at + "amplitude/unit"});
  CHECK(faults_of(plant, {{0.1, "m/s"}, {0, "°"}, {50, "Hz"}}) == Pointers{at + "phase/unit"});
  CHECK(faults_of(plant, {{0.1, "m/s"}, {0, "rad"}, {0, "Hz"}}) ==
        Pointers{at + "frequency/value"});
  AND_THEN("so is one in the levels of a random vibration") {
    sim::PlantSpec levels = plant;
    for (sim::OutputSpec& output : levels.outputs) {
      output.compared_by = sim::ComparedBy::envelope;
      output.to_Hz = 100;
    }
    CHECK(faults_of(levels, {{0.1, "m/s"}, {0, "rad"}, {50, "Hz"}}) == Pointers{"/outputs/1/hums"});
  }
  CHECK_THROWS_AS(humming(plant, "no such", 1, "m"), std::invalid_argument);
}

SCENARIO("a hum is looked for in every channel", "[sim][hum]") {
  CHECK(places_in("rv20e_bench") ==
        std::vector<std::string>{"input_torque channel", "input_angle channel"});
  CHECK(places_in("emps") == std::vector<std::string>{"vir channel"});
  CHECK(places_in("bearing_housing").empty());  // compared by levels
  THEN("not in one whose plant file has a hum, at whatever frequency") {
    CHECK(places_in(humming(mass_on_spring(), "v", 0.25, "m/s")) ==
          std::vector<std::string>{"x channel"});
  }
}

SCENARIO("parts of one recording hum in step", "[sim][hum]") {
  const sim::PlantSpec plant = humming(mass_on_spring(), "v", 0.25, "m/s");
  std::vector<Channel> push = test::sine_of(2);
  push[0].samples.setZero();
  const auto whole = test::run_of(plant, push);
  push[0].start_s = 7.003;  // not a whole number of periods
  const auto part = test::run_of(plant, push);
  for (Eigen::Index i = 0; i < 20; ++i) {
    const double t_s = 7.003 + double(i) / test::sine_rate_Hz;
    CHECK(part[1].samples[i] ==
          Approx(0.25 * std::cos(2 * std::numbers::pi * 50 * t_s + 0.7)).margin(1e-9));
  }
  CHECK(whole[1].samples[0] == Approx(0.25 * std::cos(0.7)));
}

SCENARIO("what a program's effect in a channel leaves unsaid is in that channel's unit",
         "[sim][hum]") {
  sim::TermLibrary library;
  sim::TermType type = *sim::standard_terms().find("mains_hum");
  for (sim::ParameterCard& card : type.parameters) card.fallback = card.start;
  library.add(type);
  const auto plant = sim::with_effect(turning(), "mains_hum", {.channel = "torque"}, {}, library);
  CHECK(plant.outputs[0].hums[0].amplitude.unit == "mV");
  CHECK(plant.outputs[0].hums[0].frequency.unit == "Hz");
}
