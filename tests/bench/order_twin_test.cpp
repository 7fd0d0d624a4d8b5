#include "bench/order_twin.hpp"

#include <catch2/catch.hpp>

#include "sim/rv_plant.hpp"
#include "tests/support/rv_campaign.hpp"
#include "tests/support/under_sanitizer.hpp"

using namespace rvbench;
using namespace rvbench::bench;

namespace {

// The bench as on its drawing, but with the mesh's own error: its strongest line.
sim::PlantSpec nominal() {
  sim::PlantSpec plant = sim::rv20e_bench();
  for (sim::TermSpec& term : plant.terms) {
    if (term.type != "planet_mesh") continue;
    term.parameters.at("profile_error") = {3e-6, "m", 50};
    term.parameters.at("profile_phase") = {0.5, "rad", 0};
  }
  return plant;
}

std::unique_ptr<Twin> twin_of(const sim::PlantSpec& plant, const Campaign& campaign) {
  auto made = OrderTwin::make(plant, campaign);
  if (auto* refusal = std::get_if<Refusal>(&made)) {
    for (const auto& fault : refusal->faults) UNSCOPED_INFO(fault.pointer << ": " << fault.message);
    FAIL("refused");
  }
  return std::get<0>(std::move(made));
}

std::vector<double> nominal_values(const Twin& twin) {
  std::vector<double> values;
  for (const analysis::ModelParameter& p : twin.base()) values.push_back(p.nominal);
  return values;
}

// Two conditions, once each: enough to compare, too little to explain.
test::RvMatrix two_records() {
  test::RvMatrix matrix;
  matrix.speeds_rpm = {605};  // the mesh's second harmonic, which two planets do not cancel: 180 Hz
  matrix.loads_pct = {0, 150};
  matrix.repeats = 1;
  matrix.friction_scatter = 0;  // which single records cannot tell from a wrong plant
  return matrix;
}

}  // namespace

SCENARIO("a plant by orders shows what time integration recorded of it", "[bench][orders]") {
  if (test::too_long_under_sanitizer()) return;
  const auto twin = twin_of(nominal(), test::rv_campaign(nominal(), 1, two_records()));
  const std::vector<double> values = nominal_values(*twin);
  const auto apart = twin->residuals({}, values, {true, true});
  REQUIRE(apart);
  THEN("each line and mean is within a few of its errors") {
    CHECK(std::sqrt(apart->squaredNorm() / double(apart->size())) < 2);
  }
  THEN("a wrong number shows") {
    std::vector<double> wrong = values;
    for (std::size_t i = 0; i < wrong.size(); ++i) {
      if (twin->base()[i].name.find("profile_error") != std::string::npos) wrong[i] *= 1.5;
    }
    CHECK(twin->residuals({}, wrong, {true, true})->squaredNorm() > 4 * apart->squaredNorm());
  }
}

SCENARIO("a stand-in is exact where it was made, and good nearby", "[bench][orders]") {
  if (test::too_long_under_sanitizer()) return;
  const auto twin = twin_of(nominal(), test::rv_campaign(nominal(), 2, two_records()));
  const std::vector<double> here = nominal_values(*twin);
  const std::vector<bool> all{true, true};
  const auto stand_in = twin->straightened({}, here, nullptr);
  REQUIRE(stand_in);
  const Eigen::VectorXd before = *twin->residuals({}, here, all);
  CHECK((*stand_in->residuals({}, here, all) - before).norm() < 1e-9 * before.norm());
  for (const std::size_t i : {0, 7, 12, 19}) {
    CAPTURE(twin->base()[i].name);
    std::vector<double> there = here;
    there[i] += 0.5 * twin->base()[i].spread;
    const Eigen::VectorXd moved = *twin->residuals({}, there, all);
    CHECK((*stand_in->residuals({}, there, all) - moved).norm() <
          0.2 * (moved - before).norm() + 1e-3 * before.norm());
    const auto taken_over = twin->straightened({}, there, stand_in.get());
    REQUIRE(taken_over);
    CHECK((*taken_over->residuals({}, there, all) - moved).norm() < 1e-9 * moved.norm());
  }
}

TEST_CASE("a plant without an angle of reference is not compared by orders", "[bench][orders]") {
  sim::PlantSpec blind = nominal();
  blind.outputs.pop_back();
  const auto made = OrderTwin::make(blind, test::rv_campaign(nominal(), 1, two_records()));
  REQUIRE(std::holds_alternative<Refusal>(made));
  CHECK(std::get<Refusal>(made).faults.front().pointer == "/outputs");
}

TEST_CASE("a record of fewer than four output turns is refused with its reason",
          "[bench][orders]") {
  test::RvMatrix shorter = two_records();
  shorter.periods = 3.5;
  const auto made = OrderTwin::make(nominal(), test::rv_campaign(nominal(), 1, shorter));
  REQUIRE(std::holds_alternative<Refusal>(made));
  CHECK(std::get<Refusal>(made).faults.front().message.find("lines cannot be parted") !=
        std::string::npos);
}
