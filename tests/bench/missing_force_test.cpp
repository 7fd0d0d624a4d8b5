#include "bench/missing_force.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "bench/located.hpp"
#include "bench/missing_force_json.hpp"
#include "bench/order_twin.hpp"
#include "bench/report/explanation_sections.hpp"
#include "sim/retuning.hpp"
#include "sim/rv_plant.hpp"
#include "tests/support/rv_campaign.hpp"
#include "tests/support/under_sanitizer.hpp"

using namespace rvbench;
using namespace rvbench::bench;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

// What a bench that differs from its plant shows of where it does.
MissingForce missing_of(const sim::PlantSpec& machine) {
  const sim::PlantSpec plant = test::with_mesh_error(sim::rv20e_bench());
  const auto made = OrderTwin::make(plant, test::rv_campaign(machine, 5));
  REQUIRE(std::holds_alternative<std::unique_ptr<Twin>>(made));
  const Twin& twin = *std::get<0>(made);
  std::vector<double> values;
  for (const analysis::ModelParameter& p : twin.base()) values.push_back(p.nominal);
  const Twin::Cells cells = twin.cells({}, values);
  return find_missing_force(twin.pushed_features({}, values),
                            analysis::locate(cells.all, cells.beside));
}

std::vector<std::string> names_of(const MissingForce& missing, const analysis::PushSource& source) {
  std::vector<std::string> names;
  for (const std::size_t site : source.sites) names.push_back(missing.sites[site].name);
  std::ranges::sort(names);
  return names;
}

MissingForce example() {
  MissingForce missing;
  missing.sites = {{"input_shaft", "input_shaft", "N·m", false},
                   {"planet_1", "planet_1", "N·m", false},
                   {"stage_1", "planet_1", "N·m", true}};
  missing.pushes.lines = {{analysis::LockedTo::shaft,
                           12.893,
                           {{2, 0.971, 0.004, 1e-9, 0.0243, true},
                            {1, 0.95, 0.01, 1e-9, 0.006, true},
                            {0, 0.1, 0.1, 0.5, 0.002, false}}}};
  missing.pushes.sources = {{{0}, {2, 1}}};
  missing.transducer = "input_torque";
  missing.left = {"motor"};
  missing.right = {"input_shaft", "planet_1"};
  missing.balances = {{analysis::Side::right, 0.121, 0.01, 0.05, 0.19, 0.03, 0.001}};
  return missing;
}

}  // namespace

SCENARIO("where the bench differs from its plant, the missing force is located",
         "[bench][orders][locate]") {
  if (test::too_long_under_sanitizer()) return;
  const sim::PlantSpec plant = test::with_mesh_error(sim::rv20e_bench());
  GIVEN("pins of uneven height: which stage they shake, a torque at the input cannot tell") {
    const auto missing =
        missing_of(sim::with_effect(plant, "pin_ripple", {"planet_1", "carrier"},
                                    {{"pin_error", {0.3e-6, "m"}}, {"pin_phase", {2.2, "rad"}}}));
    REQUIRE(missing.pushes.sources.size() == 1);
    const analysis::PushSource& source = missing.pushes.sources[0];
    CHECK(names_of(missing, source) == std::vector<std::string>{"stage_1", "stage_2"});
    // As large as the stages' stiffness makes it of the pins' error, on the planet.
    const double error_rad = 0.3e-6 / 52e-3;
    const analysis::SitePush& best = missing.pushes.lines[source.lines[0]].sites[0];
    CHECK(best.size == Approx(2 * 84e3 * error_rad / 40).epsilon(0.02));
    CHECK(missing.balances.empty());
  }
  GIVEN("a tenth more friction than the plant's 0.15 N·m") {
    sim::PlantSpec machine = plant;
    for (sim::TermSpec& term : machine.terms) {
      if (term.name == "shaft_friction") term.parameters.at("level").value *= 1.1;
    }
    const auto missing = missing_of(machine);
    CHECK(missing.pushes.sources.empty());
    REQUIRE(missing.balances.size() == 1);
    const analysis::SideBalance& drag = missing.balances[0];
    CHECK(drag.side == analysis::Side::right);
    CHECK(drag.mean_Nm == Approx(0.015).margin(3 * drag.standard_error_Nm));
    CHECK(missing.left == std::vector<std::string>{"motor"});
    CHECK(missing.right.size() == 5);
  }
  GIVEN("a motor that slips by a tenth more") {
    sim::PlantSpec machine = plant;
    for (sim::TermSpec& term : machine.terms) {
      if (term.name == "motor_torque") term.parameters.at("pull_out_slip").value *= 1.1;
    }
    const auto missing = missing_of(machine);
    REQUIRE(missing.balances.size() == 1);
    CHECK(missing.balances[0].side == analysis::Side::left);
    CHECK(missing.balances[0].mean_Nm < 0);
    CHECK_THAT(analysis::law_text(missing.balances[0]), StartsWith("falls with load"));
  }
  GIVEN("mains hum on the brake: at one frequency all that turns together answers alike") {
    const auto missing = missing_of(sim::with_effect(
        plant, "external_force", {"brake", "housing"},
        {{"amplitude", {5, "N·m"}}, {"phase", {0, "rad"}}, {"frequency", {100, "Hz"}}}));
    REQUIRE(!missing.pushes.lines.empty());
    CHECK(missing.pushes.sources.empty());
    for (const analysis::SitePush& push : missing.pushes.lines[0].sites) {
      CHECK(push.share > 0.99);
      if (missing.sites[push.site].name == "brake") CHECK(push.size == Approx(5).epsilon(0.02));
    }
  }
  GIVEN("nothing") { CHECK(told(missing_of(plant), 9).empty()); }
}

TEST_CASE("a missing force is told in one line each", "[bench][explain][locate]") {
  const MissingForce missing = example();
  const auto lines = told(missing, 9);
  REQUIRE(lines.size() == 2);
  CHECK(lines[0] ==
        "order 12.893: a force in stage_1 (or on planet_1) explains 97 ± 1 %; 0.024 N·m on "
        "planet_1");
  CHECK(lines[1] ==
        "means: right of input_torque (input_shaft, planet_1), drag differs by +0.12 ± 0.01 N·m "
        "(+0.05 to +0.19; rises with load)");
  CHECK(told(missing, 0).size() == 1);
  CHECK(told({}, 9).empty());
}

TEST_CASE("the page says where forces act that were left out, and where what is left over does",
          "[bench][explain][locate]") {
  Located located{240, 9, {}, {}};
  CHECK_THAT(report::located_section(located), !Contains("acts:"));
  located.missing_before = example();
  const std::string html = report::located_section(located);
  CHECK_THAT(html, Contains("Where what was left out acts:") && Contains("a force in stage_1") &&
                       Contains("right of input_torque"));
  CHECK_THAT(html, !Contains("left over acts"));
  located.missing_after = example();
  CHECK_THAT(report::located_section(located), Contains("Where what is left over acts:"));
}

TEST_CASE("explain.json has each line's sites, and what they come to", "[bench][explain][locate]") {
  const nlohmann::json json = missing_force_to_json(example());
  CHECK(json.at("sources").size() == 1);
  CHECK(json.at("sources")[0].at("sites") == nlohmann::json{"stage_1", "planet_1"});
  CHECK(json.at("lines")[0].at("sites")[0].at("joint") == "stage_1");
  CHECK(json.at("lines")[0].at("sites")[2].at("as_good_as_best") == false);
  CHECK(json.at("balances")[0].at("side") == "right");
  CHECK(json.at("balances")[0].at("per_load").at("value") == 0.03);
}
