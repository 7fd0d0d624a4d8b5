#include "sim/plant_json.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/sim/plant_texts.hpp"
#include "tests/support/replaced.hpp"

using namespace rvbench;
using test::mass_on;
using test::plant_of;
using test::replaced;

namespace {

std::string faults_of(const std::string& text) {
  const auto read = sim::parse_plant(hal::ConfigReader::from_text(text, "plant.json"));
  std::string all;
  if (const auto* faults = std::get_if<std::vector<hal::ConfigFault>>(&read)) {
    for (const auto& fault : *faults) all += describe("plant.json", fault) + '\n';
  }
  return all;
}

const std::string good = R"plant({
  "plant": "two",
  "bodies": [
    {"name": "motor", "motion": "rotation", "inertia": {"value": 0.1, "unit": "kg·m²", "tolerance_pct": 10}},
    {"name": "arm", "motion": "rotation", "inertia": {"value": 0.4, "unit": "kg·m²", "tolerance_pct": "free"}}
  ],
  "terms": [
    {"type": "spring", "body_a": "motor", "body_b": "arm", "name": "belt",
     "parameters": {"stiffness": {"value": 90, "unit": "N·m/rad"}}},
    {"type": "load_friction", "body_a": "arm", "load": "belt",
     "parameters": {"coefficient": {"value": 0.1, "unit": "1"}, "creep_speed": {"value": 0.01, "unit": "rad/s"}}},
    {"type": "cascade_controller", "body_a": "motor", "set_point": "wanted",
     "parameters": {"position_gain": {"value": 5, "unit": "Hz"}, "speed_gain": {"value": 2, "unit": "N·m·s/rad"}}}
  ],
  "inputs": [
    {"channel": "wanted", "unit": "rad", "is": "signal"},
    {"channel": "i", "unit": "A", "is": "force", "body": "arm", "gain": {"value": 2, "unit": "N·m/A"}}
  ],
  "outputs": [
    {"channel": "torque", "unit": "V", "is": "effort", "term": "belt", "gain": {"value": 0.1, "unit": "V/(N·m)"}},
    {"channel": "angle", "unit": "rad", "is": "position", "body": "arm"}
  ]
})plant";

// −A·v³, of another program.
class Fan final : public sim::OneAxisTerm {
 public:
  Fan(sim::Axis axis, double drag) : OneAxisTerm("fan", axis), drag_(drag) {}
  double effort(const sim::PlantState& s) const override {
    return drag_ * speed(s) * speed(s) * speed(s);
  }
  double dissipated_power_W(const sim::PlantState& s) const override {
    return effort(s) * speed(s);
  }

 private:
  double drag_;
};

}  // namespace

TEST_CASE("a plant file becomes a plant, with every default in place", "[sim][plant_file]") {
  const auto plant = plant_of(good);
  CHECK(plant.bodies[0].inertia.tolerance_pct == 10);
  CHECK(plant.bodies[1].inertia.tolerance_pct == sim::Quantity::free_pct);
  CHECK(plant.terms[0].name == "belt");
  CHECK(plant.terms[1].name == "load_friction");
  CHECK(plant.terms[1].body_b == "housing");
  CHECK(plant.terms[1].reference == "belt");
  CHECK(plant.terms[2].parameters.at("integral_time").value == 1e9);
  CHECK(plant.inputs[1].gain.value == 2);
  CHECK(plant.inputs[1].between == sim::Between::band_limited);
  CHECK(plant.outputs[1].gain.unit == "1");
  CHECK(plant.outputs[1].delay.unit == "s");
}

TEST_CASE("what is written reads back, and is written the same again", "[sim][plant_file]") {
  const std::string name = GENERATE("", "emps", "rv20e_bench", "silverbox", "ur10e_joint");
  const auto plant =
      name.empty() ? plant_of(good) : std::get<sim::PlantSpec>(sim::read_plant(name));
  const std::string once = sim::write_plant(plant);
  CHECK(sim::write_plant(plant_of(once)) == once);
  CHECK_THAT(once, Catch::Contains("\"tolerance_pct\": 0") && Catch::Contains("\"delay\"") &&
                       Catch::Contains("\"body_b\": \"housing\""));
}

TEST_CASE("every quantity of a plant can be found and moved", "[sim][plant_file]") {
  auto plant = plant_of(good);
  bool found = false;
  for (const sim::PlacedQuantity& placed : sim::quantities(plant)) {
    if (placed.pointer != "/terms/0/parameters/stiffness") continue;
    found = true;
    placed.quantity->value = 123;
  }
  CHECK(found);
  CHECK(plant.terms[0].parameters.at("stiffness").value == 123);
}

SCENARIO("a bad plant file is told all its faults, with their places", "[sim][plant_file]") {
  CHECK(faults_of(good).empty());
  const auto fault = [](const std::string& what, const std::string& with) {
    return faults_of(replaced(good, what, with));
  };
  CHECK(fault("\"spring\"", "\"sprung\"") ==
        "plant.json:8: /terms/0/type: no type of term is called \"sprung\", did you mean "
        "\"spring\"?\n");
  CHECK(fault("\"body_b\": \"arm\"", "\"body_b\": \"arn\"") ==
        "plant.json:8: /terms/0/body_b: no body is called \"arn\", did you mean \"arm\"?\n");
  CHECK(fault("\"N·m/rad\"", "\"N/m\"") ==
        "plant.json:9: /terms/0/parameters/stiffness/unit: expected \"N·m/rad\", found \"N/m\"\n");
  CHECK(fault("\"value\": 90", "\"value\": -90") ==
        "plant.json:9: /terms/0/parameters/stiffness/value: -90 is below 0\n");
  CHECK(fault("\"value\": 0.1, \"unit\": \"kg·m²\"", "\"value\": 0, \"unit\": \"kg·m²\"") ==
        "plant.json:4: /bodies/0/inertia/value: 0 must be above 0\n");
  CHECK(fault("\"value\": 0.1, \"unit\": \"kg·m²\"", "\"value\": 1e300, \"unit\": \"kg·m²\"") ==
        "plant.json:4: /bodies/0/inertia/value: 1e+300 is above 1000000000000\n");
  CHECK(fault("\"value\": 0.1, \"unit\": \"kg·m²\"", "\"value\": 1e-30, \"unit\": \"kg·m²\"") ==
        "plant.json:4: /bodies/0/inertia/value: 1e-30 is below 1e-12\n");
  CHECK(fault("\"load\": \"belt\"", "\"load\": \"belts\"") ==
        "plant.json:10: /terms/1/load: no term is called \"belts\", did you mean \"belt\"?\n");
  CHECK(fault("\"set_point\": \"wanted\"", "\"set_point\": \"i\"").empty());
  CHECK(fault("\"set_point\": \"wanted\"", "\"setpoint\": \"wanted\"") ==
        "plant.json:12: /terms/2/set_point: this key is missing\n"
        "plant.json:12: /terms/2/setpoint: unknown key, did you mean \"set_point\"?\n");
  CHECK(fault("\"coefficient\"", "\"coeficient\"") ==
        "plant.json:11: /terms/1/parameters/coefficient: this key is missing\n"
        "plant.json:11: /terms/1/parameters/coeficient: load_friction has no such parameter, did "
        "you mean \"coefficient\"?\n");
  CHECK(fault("\"N·m/A\"", "\"N/A\"") ==
        "plant.json:17: /inputs/1/gain/unit: expected \"N·m/A\", found \"N/A\"\n");
  CHECK(fault("\"is\": \"effort\", \"term\": \"belt\"", "\"is\": \"drive\", \"body\": \"arm\"") ==
        "plant.json:20: /outputs/0/body: no input prescribes its motion: what drives it is "
        "known\n");
  CHECK(fault("\"rotation\", \"inertia\": {\"value\": 0.4",
              "\"spin\", \"inertia\": {\"value\": "
              "0.4") ==
        "plant.json:5: /bodies/1/motion: expected one of \"rotation\", \"translation\"; found "
        "\"spin\"\n");
  CHECK(fault("\"free\"", "\"fre\"") ==
        "plant.json:5: /bodies/1/inertia/tolerance_pct: expected a number or \"free\"\n");
  CHECK(fault("\"arm\", \"motion\"", "\"motor\", \"motion\"") != "");
  CHECK(fault("\"spring\"", "\"series_compliance\"") ==
        "plant.json:8: /terms/0/type: changes the structure: write down the bodies and springs it "
        "makes\n");
  CHECK_THAT(faults_of("{}"), Catch::Contains("/bodies: this key is missing") &&
                                  Catch::Contains("/outputs: this key is missing"));
  CHECK_THAT(faults_of("[1"), Catch::Contains("plant.json:1"));
}

TEST_CASE("a plant that nothing drives is refused", "[sim][plant_file]") {
  CHECK_THAT(faults_of(R"({"plant": "still",
    "bodies": [{"name": "m", "motion": "translation", "mass": {"value": 1, "unit": "kg"}}],
    "terms": [], "inputs": [],
    "outputs": [{"channel": "x", "unit": "m", "is": "position", "body": "m"}]})"),
             Catch::Contains("/inputs: needs at least one input"));
}

TEST_CASE("two faults far apart are both told", "[sim][plant_file]") {
  CHECK(faults_of(
            replaced(replaced(good, "\"value\": 90", "\"value\": -90"), "\"N·m/A\"", "\"N/A\"")) ==
        "plant.json:9: /terms/0/parameters/stiffness/value: -90 is below 0\n"
        "plant.json:17: /inputs/1/gain/unit: expected \"N·m/A\", found \"N/A\"\n");
}

SCENARIO("a term from outside the tree works by its name", "[sim][plant_file]") {
  const std::string text = mass_on(R"({"type": "fan", "body_a": "m",
    "parameters": {"drag": {"value": 0.5, "unit": "1"}}})",
                                   R"("start_speed_m_s": 4, )");
  CHECK_THAT(faults_of(text), Catch::Contains("no type of term is called \"fan\""));
  sim::TermLibrary library = sim::standard_terms();
  library.add(
      {.card = {.name = "fan", .equation = "F = A·v³"},
       .parameters = {{.name = "drag", .min = 0, .max = 10, .start = 1}},
       .make = [](const sim::TermSite& at) { return std::make_unique<Fan>(at.axis, at["drag"]); }});
  const auto plant = plant_of(text, library);
  const auto out =
      test::run_of(plant, {test::channel_of("u", "N", 100, Eigen::VectorXd::Zero(101))}, library);
  // 2·v' = −0.5·v³ → 1/v² = 1/16 + 0.5·t
  CHECK(out[1].samples[100] == Approx(1 / std::sqrt(1.0 / 16 + 0.5)).epsilon(1e-5));
  CHECK_THROWS_AS(library.add({.card = {.name = "fan"}}), std::invalid_argument);
}

SCENARIO("an effect is an edit of the plant", "[sim][effects]") {
  auto plant = plant_of(mass_on(R"({"type": "spring", "body_a": "m",
    "parameters": {"stiffness": {"value": 800, "unit": "N/m"}}})"));
  const std::vector<Channel> rest{
      test::channel_of("u", "N", 1000, Eigen::VectorXd::Constant(1000, 8))};
  WHEN("it is one more term") {
    const auto more =
        sim::with_effect(plant, "cubic_stiffness", {.body_a = "m"}, {{"stiffness", {500, "N/m³"}}});
    CHECK(more.terms.size() == 2);
    CHECK(more.terms[1].name == "cubic_stiffness");
    CHECK(sim::write_plant(plant_of(sim::write_plant(more))) == sim::write_plant(more));
    const auto none =
        sim::with_effect(plant, "cubic_stiffness", {.body_a = "m"}, {{"stiffness", {0, "N/m³"}}});
    CHECK((test::run_of(none, rest)[0].samples - test::run_of(plant, rest)[0].samples)
              .cwiseAbs()
              .maxCoeff() < 1e-12);
  }
  WHEN("a spring gets play") {
    const auto loose = sim::with_effect(plant, "backlash", {.body_a = "m", .reference = "spring"},
                                        {{"gap", {0.02, "m"}}});
    REQUIRE(loose.terms.size() == 1);
    CHECK(loose.terms[0].type == "backlash");
    CHECK(loose.terms[0].parameters.at("stiffness").value == 800);
    THEN("it gives way by half the play before it pulls") {
      auto calm = loose;
      calm.terms.push_back({"damper", "damper", "m", "housing", "", {{"damping", {60, "N·s/m"}}}});
      const auto out = test::run_of(
          calm, {test::channel_of("u", "N", 1000, Eigen::VectorXd::Constant(3000, 8))});
      CHECK(out[0].samples[2999] == Approx(0.01 + 8.0 / 800));
    }
  }
  WHEN("the drive turns out to be elastic") {
    const auto soft =
        sim::with_effect(plant, "series_compliance", {.body_a = "m", .beyond = {"spring"}},
                         {{"stiffness", {1600, "N/m"}}, {"far_share", {0.25, "1"}}});
    REQUIRE(soft.bodies.size() == 2);
    CHECK(soft.bodies[0].inertia.value + soft.bodies[1].inertia.value == Approx(2));
    CHECK(soft.terms[0].body_a == soft.bodies[1].name);
    THEN("static deflection is that of both springs in series") {
      auto calm = soft;
      for (auto& term : calm.terms) {
        if (term.type == "damper") term.parameters.at("damping").value = 60;
      }
      calm.terms.push_back({"brake", "damper", "m", "housing", "", {{"damping", {60, "N·s/m"}}}});
      const auto out = test::run_of(
          calm, {test::channel_of("u", "N", 1000, Eigen::VectorXd::Constant(5000, 8))});
      CHECK(out[0].samples[4999] == Approx(8.0 / 800 + 8.0 / 1600));
    }
  }
  WHEN("a resonance hangs on it") {
    plant.terms.clear();
    const auto ringing = sim::with_effect(
        plant, "torsional_mode", {.body_a = "m"},
        {{"frequency", {10, "Hz"}}, {"damping_ratio", {0, "1"}}, {"inertia_share", {0.5, "1"}}});
    // The mode alone on a fixed base has 10 Hz; with 1 kg on each side the pair rings at √2·10 Hz.
    const auto out = test::run_of(ringing, rest);
    const double w = 2 * std::acos(-1.0) * 10 * std::sqrt(2.0);
    for (int i : {100, 400, 999}) {
      const double t = i / 1000.0;
      const double stretch_m = 8 / (w * w) * (1 - std::cos(w * t));
      CHECK(out[0].samples[i] == Approx(2 * t * t + stretch_m / 2).margin(1e-12));
    }
  }
  CHECK_THROWS_AS(sim::with_effect(plant, "no_such", {.body_a = "m"}, {}), std::invalid_argument);
  CHECK_THROWS_AS(sim::with_effect(plant, "torque_offset", {.body_a = "n"}, {}),
                  std::invalid_argument);
}
