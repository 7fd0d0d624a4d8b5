#include "sim/effect_sites.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "sim/effect_edits.hpp"
#include "sim/rv_plant.hpp"
#include "tests/sim/plant_texts.hpp"

namespace rvbench::sim {
namespace {

std::vector<std::string> places_of(const PlantSpec& plant, const std::string& effect) {
  std::vector<std::string> places;
  for (const EffectSite& site : sites_of(plant, *standard_terms().find(effect))) {
    places.push_back(describe(site));
  }
  return places;
}

PlantSpec two_masses() {
  return test::plant_of(R"({"plant": "pair",
    "bodies": [{"name": "a", "motion": "translation", "mass": {"value": 2, "unit": "kg"}},
               {"name": "b", "motion": "translation", "mass": {"value": 1, "unit": "kg"}}],
    "terms": [{"type": "spring", "body_a": "a", "body_b": "b",
               "parameters": {"stiffness": {"value": 10, "unit": "N/m"}}},
              {"type": "coulomb_friction", "body_a": "a",
               "parameters": {"level": {"value": 1, "unit": "N"},
                              "creep_speed": {"value": 0.001, "unit": "m/s"}}}],
    "inputs": [{"channel": "u", "unit": "N", "is": "force", "body": "a"}],
    "outputs": [{"channel": "x", "unit": "m", "is": "position", "body": "b"}]})");
}

}  // namespace

TEST_CASE("an effect is tried on every body and every joint, but not twice", "[sim][explain]") {
  const PlantSpec pair = two_masses();
  CHECK(places_of(pair, "cubic_stiffness") ==
        std::vector<std::string>{"a against the housing", "b against the housing", "a and b"});
  CHECK(places_of(pair, "coulomb_friction") ==
        std::vector<std::string>{"b against the housing", "a and b"});
}

TEST_CASE("a joint is one place, whichever body its terms call the first", "[sim][explain]") {
  PlantSpec pair = two_masses();
  TermSpec damper = pair.terms[0];
  damper.name = "damper";
  damper.type = "damper";
  std::swap(damper.body_a, damper.body_b);
  damper.parameters = {{"damping", {1, "N·s/m", 0}}};
  pair.terms.push_back(damper);
  const auto places = places_of(pair, "cubic_stiffness");
  CHECK(places.size() == 3);
  CHECK(std::ranges::count(places, "b and a") == 0);
}

TEST_CASE("what needs a rotor, or another term, is tried where there is one", "[sim][explain]") {
  const PlantSpec pair = two_masses();
  CHECK(places_of(pair, "unbalance").empty());
  const auto loaded = places_of(pair, "load_friction");
  CHECK(std::ranges::count(loaded, "a and b, by spring") == 1);
}

TEST_CASE("friction grows with what carries a load, not with other friction", "[sim][explain]") {
  PlantSpec pair = two_masses();
  TermSpec drag = pair.terms[0];
  drag.name = "drag";
  drag.type = "viscous_friction";
  drag.parameters = {{"damping", {1, "N·s/m", 0}}};
  pair.terms.push_back(drag);
  const auto loaded = places_of(pair, "load_friction");
  CHECK(std::ranges::count(loaded, "a and b, by spring") == 1);
  CHECK(std::ranges::count(loaded, "a and b, by drag") == 0);
}

TEST_CASE("what all parts of a kind have is in all their joints", "[sim][explain]") {
  CHECK(places_of(rv20e_bench(), "pin_ripple") ==
        std::vector<std::string>{"planet_1 and carrier, planet_2 and carrier alike"});
  CHECK(places_of(rv20e_bench(), "crank_eccentricity") ==
        std::vector<std::string>{"planet_1 and carrier, by stage_1",
                                 "planet_2 and carrier, by stage_2"});
}

TEST_CASE("probes show a body's motion in place of the plant's own sensors", "[sim][explain]") {
  const PlantSpec probed =
      with_probes(two_masses(), "b", {OutputKind::position, OutputKind::speed});
  REQUIRE(probed.outputs.size() == 2);
  CHECK(probed.outputs[0].unit == "m");
  CHECK(probed.outputs[1].unit == "m/s");
  Eigen::VectorXd push = Eigen::VectorXd::Constant(200, 3.0);
  const auto shown = test::run_of(probed, {test::channel_of("u", "N", 100, push)});
  const auto own = test::run_of(two_masses(), {test::channel_of("u", "N", 100, push)});
  CHECK(shown[0].samples.isApprox(own[0].samples));
}

}  // namespace rvbench::sim
