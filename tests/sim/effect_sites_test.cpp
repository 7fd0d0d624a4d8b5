#include "sim/effect_sites.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "sim/effect_edits.hpp"
#include "sim/plant_json.hpp"
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

TEST_CASE("slip takes the place of a synchronous drive, and is tried nowhere else",
          "[sim][explain]") {
  CHECK(places_of(two_masses(), "slip").empty());
  const auto read = read_plant("oedi_gearbox");
  REQUIRE(read.index() == 0);
  const PlantSpec& gearbox = std::get<PlantSpec>(read);
  const auto sites = sites_of(gearbox, *standard_terms().find("slip"));
  REQUIRE(sites.size() == 1);
  const PlantSpec slipping = with_effect(gearbox, "slip", sites[0], {{"rated_slip", {0.04, "1"}}});
  REQUIRE(slipping.terms.size() == 1);
  CHECK(slipping.terms[0].type == "slip");
  CHECK(slipping.terms[0].parameters.at("speed").value ==
        gearbox.terms[0].parameters.at("speed").value);
  // It runs at (1 − s_r·T/T_r) of the speed that the drive keeps at any load.
  for (const double load_pct : {0.0, 50.0, 100.0}) {
    const std::vector<Channel> load{
        test::channel_of("load", "%", 10, Eigen::VectorXd::Constant(40, load_pct))};
    CHECK(test::run_of(gearbox, load)[0].samples.tail(30).isApproxToConstant(1, 2e-6));
    CHECK(test::run_of(slipping, load)[0].samples.tail(30).isApproxToConstant(
        1 - 0.04 * load_pct / 100, 1e-9));
  }
  CHECK(sites_of(slipping, *standard_terms().find("slip")).empty());
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
