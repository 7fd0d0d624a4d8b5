#include "bench/plant_family.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "sim/plant_files.hpp"
#include "sim/plant_json.hpp"

namespace rvbench::bench {
namespace {

sim::PlantSpec shipped(const std::string& name) {
  auto read = sim::read_plant(name);
  REQUIRE(read.index() == 0);
  return std::get<0>(std::move(read));
}

ParameterScales scales(std::vector<double> rhythms_Hz = {}) {
  return {{10, 1e-3, 1}, 1e-3, 10, std::move(rhythms_Hz)};
}

const analysis::Candidate& first_of(const PlantFamily& family, const std::string& name) {
  const auto found = std::ranges::find(family.candidates(), name, &analysis::Candidate::name);
  REQUIRE(found != family.candidates().end());
  return *found;
}

}  // namespace

TEST_CASE("fits of every candidate of every shipped plant begin within its bounds",
          "[bench][explain]") {
  for (const auto& file : sim::plant_files()) {
    const PlantFamily family(shipped(std::string(file.name)), scales(), sim::standard_terms());
    for (const analysis::Candidate& candidate : family.candidates()) {
      CAPTURE(file.name, candidate.name, candidate.where);
      CHECK(candidate.starts.size() >= 2);
      for (const std::vector<double>& start : candidate.starts) {
        REQUIRE(start.size() == candidate.parameters.size());
        for (std::size_t i = 0; i < start.size(); ++i) {
          CHECK(start[i] >= candidate.parameters[i].low);
          CHECK(start[i] <= candidate.parameters[i].high);
        }
      }
    }
  }
}

TEST_CASE("a force that keeps its own time has one of the frequencies that can be told",
          "[bench][explain]") {
  const PlantFamily told(shipped("emps"), scales({50, 100}), sim::standard_terms());
  const analysis::Candidate& force = first_of(told, "external_force");
  CHECK(force.where.ends_with("at 50 Hz"));
  CHECK(force.parameters.size() == 2);  // cosine and sine part
  const auto count =
      std::ranges::count(told.candidates(), "external_force", &analysis::Candidate::name);
  const PlantFamily fitted(shipped("emps"), scales(), sim::standard_terms());
  CHECK(count ==
        2 * std::ranges::count(fitted.candidates(), "external_force", &analysis::Candidate::name));
  CHECK(first_of(fitted, "external_force").parameters.size() == 3);
}

TEST_CASE("a hum that is fitted may vanish, and keeps nearly its frequency",
          "[bench][explain][hum]") {
  sim::PlantSpec plant = shipped("emps");
  const double free = sim::Quantity::free_pct;
  plant.outputs[0].hums = {{{0.2, "V", free}, {0, "rad", free}, {50, "Hz", free}}};
  const PlantFamily family(plant, scales(), sim::standard_terms());
  const auto of_hum = [&](const std::string& name) {
    const std::string pointer = "/outputs/0/hums/0/" + name;
    return *std::ranges::find(family.base(), pointer, &analysis::ModelParameter::name);
  };
  CHECK(of_hum("amplitude").low == 0);
  CHECK(of_hum("amplitude").scale == Approx(0.01));
  CHECK(of_hum("frequency").scale == Approx(0.05));  // a turn in 20 s
  CHECK(of_hum("phase").low < -10);
}

TEST_CASE("a body that turns slowly rubs at the power of a fast one", "[bench][explain]") {
  // The input shaft makes 121 turns while the carrier makes one.
  const sim::PlantSpec plant = shipped("rv20e_bench");
  ParameterScales by_speed = scales();
  for (const sim::BodySpec& body : plant.bodies) {
    by_speed.turns.push_back(body.name == "carrier" ? 1.0 / 121 : 1.0);
  }
  const auto scale_on = [](const PlantFamily& family, const std::string& where) {
    const auto found = std::ranges::find_if(family.candidates(), [&](const auto& c) {
      return c.name == "coulomb_friction" && c.where == where;
    });
    REQUIRE(found != family.candidates().end());
    return found->parameters.front().scale;
  };
  const PlantFamily even(plant, scales(), sim::standard_terms());
  const PlantFamily family(plant, by_speed, sim::standard_terms());
  const std::string carrier = "carrier against the housing";
  CHECK(scale_on(family, carrier) == Approx(121 * scale_on(even, carrier)));
}

}  // namespace rvbench::bench
