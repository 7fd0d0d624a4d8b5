#include "sim/retuning.hpp"

#include <catch2/catch.hpp>

#include "sim/effect_sites.hpp"
#include "sim/plant_check.hpp"
#include "sim/rv_plant.hpp"
#include "sim/steady_state.hpp"

using namespace rvbench;
using sim::EffectSite;
using sim::PlantSpec;

namespace {

std::vector<EffectSite> sites(const PlantSpec& plant, const std::string& effect) {
  return sim::sites_of(plant, *sim::standard_terms().find(effect));
}

double value(const PlantSpec& plant, const std::string& term, const std::string& parameter) {
  return plant.find_term(term)->parameters.at(parameter).value;
}

}  // namespace

SCENARIO("errors of the teeth belong to all meshes, eccentricities to one", "[sim][effects]") {
  const PlantSpec plant = sim::rv20e_bench();
  REQUIRE(sites(plant, "transmission_error").size() == 1);
  CHECK(sites(plant, "pin_ripple").size() == 1);
  CHECK(sites(plant, "sun_tooth_error").size() == 1);
  REQUIRE(sites(plant, "gear_eccentricity").size() == 2);
  CHECK(sites(plant, "crank_eccentricity").size() == 2);
  WHEN("one is added") {
    const PlantSpec all =
        sim::with_effect(plant, "transmission_error", sites(plant, "transmission_error")[0],
                         {{"profile_error", {2e-6, "m"}}, {"profile_phase", {0.3, "rad"}}});
    const PlantSpec one = sim::with_effect(
        plant, "gear_eccentricity", sites(plant, "gear_eccentricity")[1],
        {{"planet_eccentricity", {5e-6, "m"}}, {"planet_eccentricity_phase", {1, "rad"}}});
    THEN("the parts that it is about deviate, and the plant stays one that can be simulated") {
      CHECK(value(all, "mesh_1", "profile_error") == 2e-6);
      CHECK(value(all, "mesh_2", "profile_error") == 2e-6);
      CHECK(value(one, "mesh_1", "planet_eccentricity") == 0);
      CHECK(value(one, "mesh_2", "planet_eccentricity") == 5e-6);
      CHECK(sim::check_plant(all).empty());
      CHECK(sim::check_plant(one).empty());
    }
    THEN("it is not tried again where it acts") {
      CHECK(sites(all, "transmission_error").empty());
      CHECK(sites(one, "gear_eccentricity").size() == 1);
    }
  }
}

SCENARIO("an error of the sun's teeth shows where both planets meet it at once", "[sim][effects]") {
  // The sun turns 120 times against the carrier while the input shaft turns 121 times; two planets
  // opposite each other cancel what goes round with it once.
  const PlantSpec plant = sim::rv20e_bench();
  const PlantSpec worn =
      sim::with_effect(plant, "sun_tooth_error", sites(plant, "sun_tooth_error")[0],
                       {{"sun_tooth_error", {10e-6, "m"}}, {"sun_tooth_phase", {1, "rad"}}});
  const auto lines = [](const PlantSpec& of) {
    const auto steady = std::get<0>(sim::SteadyPlant::make(of));
    return std::get<0>(
               steady.under(Eigen::Vector2d(2 * 1210 / 60.0, 83.5), steady.orders_up_to(600)))
        .outputs[0]
        .shaft_lines;
  };
  Eigen::VectorXd change = (lines(worn) - lines(plant)).cwiseAbs();
  change[0] = 0;
  Eigen::Index strongest = 0;
  const double most = change.maxCoeff(&strongest);
  CHECK(strongest % 240 == 0);
  CHECK(change[120] < 0.05 * most);
  for (Eigen::Index order = 1; order < change.size(); ++order) {
    if (order % 120 != 0) CHECK(change[order] < 0.05 * most);
  }
}

SCENARIO("what the plant states is not tried once more", "[sim][effects]") {
  // The shipped bench has its mesh's stiffness ripple and its motor's torque ripple.
  CHECK(sites(sim::rv20e_bench(), "mesh_stiffness_variation").empty());
  CHECK(sites(sim::rv20e_bench(), "inverter_ripple").empty());
}
