#include "bench/order_twin.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "analysis/explain/explanation.hpp"
#include "sim/rv_plant.hpp"
#include "tests/support/rv_campaign.hpp"
#include "tests/support/under_sanitizer.hpp"

using namespace rvbench;
using namespace rvbench::bench;

namespace {

sim::PlantSpec nominal() { return test::with_mesh_error(sim::rv20e_bench()); }

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
    const auto off = twin->residuals({}, wrong, {true, true});
    const double nats = (off->squaredNorm() - apart->squaredNorm()) / 2;
    CHECK(nats > 100);  // of log likelihood: by chance once in e^100
  }
}

SCENARIO("noise is told by repeats and by what is beside the lines", "[bench][orders]") {
  if (test::too_long_under_sanitizer()) return;
  test::RvMatrix matrix;
  matrix.speeds_rpm = {1815};
  matrix.loads_pct = {0};
  const auto noise_of = [&](const test::RvMatrix& run) {
    const auto twin = twin_of(nominal(), test::rv_campaign(nominal(), 3, run));
    std::map<std::string, double> of;
    for (const Twin::Noise& noise : twin->cells({}, nominal_values(*twin)).noise) {
      if (noise.channel == "input_torque") of[noise.of] = noise.standard_deviation;
    }
    return of;
  };
  auto usual = noise_of(matrix);
  THEN("means scatter as the friction of the input shaft does, and lines do not") {
    // A factor within ±1.7 · 0.5 % on 0.15 N·m: 0.7 mN·m, told by three records.
    CHECK(usual["mean, from record to record"] == Approx(0.7e-3).epsilon(0.7));
    CHECK(usual["line, from record to record"] < 1);
    test::RvMatrix rough = matrix;
    rough.friction_scatter *= 10;
    CHECK(noise_of(rough)["mean, from record to record"] ==
          Approx(10 * usual["mean, from record to record"]).epsilon(0.1));
  }
  THEN("what is beside the lines is the sensor's noise, whatever the friction") {
    test::RvMatrix loud = matrix;
    loud.torque_noise_Nm *= 3;
    CHECK(noise_of(loud)["line, by noise beside it"] ==
          Approx(3 * usual["line, by noise beside it"]).epsilon(0.1));
  }
}

TEST_CASE("a resonance is looked for beside the lines of the bench", "[bench][orders]") {
  if (test::too_long_under_sanitizer()) return;
  const auto twin = twin_of(nominal(), test::rv_campaign(nominal(), 1, two_records()));
  const auto mode = std::ranges::find_if(twin->library(), [](const analysis::Candidate& c) {
    return c.name == "torsional_mode" && c.where.starts_with("motor");
  });
  REQUIRE(mode != twin->library().end());
  CHECK(mode->not_exercised.empty());
  for (const double line_Hz : {121.0, 180.0}) {  // the supply's ripple, the mesh
    CHECK(std::ranges::any_of(mode->starts, [&](const std::vector<double>& start) {
      return std::abs(start[1] - line_Hz) < 0.1 * line_Hz;
    }));
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

SCENARIO("faults of motor, drive and brake are tried where these act", "[bench][orders]") {
  if (test::too_long_under_sanitizer()) return;
  const sim::PlantSpec barred =
      sim::with_effect(nominal(), "rotor_bar", {.body_a = "motor", .reference = "motor_torque"},
                       {{"depth", {0.2, "1"}}, {"phase", {0.4, "rad"}}});
  const test::RvMatrix matrix = two_records();
  const auto twin = twin_of(nominal(), test::rv_campaign(barred, 2, matrix));
  THEN("each has the places that its gate allows") {
    const auto places = [&](const std::string& name) {
      std::vector<std::string> where;
      for (const analysis::Candidate& c : twin->library()) {
        if (c.name != name) continue;
        where.push_back(c.where);
        CHECK(c.phasor);
        CHECK(c.parameters.size() == 2);
      }
      return where;
    };
    CHECK(places("rotor_bar") ==
          std::vector<std::string>{"motor against the housing, by motor_torque"});
    CHECK(places("brake_ripple") ==
          std::vector<std::string>{"brake against the housing, by brake_torque, once a turn",
                                   "brake against the housing, by brake_torque, twice a turn"});
    const auto hunting = places("speed_modulation");
    REQUIRE(hunting.size() == 4);
    CHECK(hunting[0] == "motor against the housing, by motor_torque, at 50 Hz");
  }
  THEN("a broken bar stands out at twice the slip frequency, and nowhere in its own plant") {
    const auto most = [](const Twin& of) {
      double farthest = 0;
      for (const auto& cell : of.cells({}, nominal_values(of)).all) {
        if (cell.locked_to != analysis::LockedTo::time || cell.place > 5) continue;
        farthest = std::max(farthest, std::abs(cell.apart) / cell.standard_error);
      }
      return farthest;
    };
    CHECK(most(*twin) > 5);
    CHECK(most(*twin_of(barred, test::rv_campaign(barred, 2, matrix))) < 3);
  }
}

SCENARIO("a broken bar is found at its size while the rotor warms from repeat to repeat",
         "[bench][orders]") {
  if (test::too_long_under_sanitizer()) return;
  const double depth = 0.2;
  const sim::PlantSpec barred =
      sim::with_effect(nominal(), "rotor_bar", {.body_a = "motor", .reference = "motor_torque"},
                       {{"depth", {depth, "1"}}, {"phase", {0.4, "rad"}}});
  test::RvMatrix matrix = two_records();
  matrix.loads_pct = {150};
  Campaign campaign;
  for (const int warmth : {-1, 0, 1}) {  // 10 K each: 4 % of the slip, three lines of a record
    const auto warm =
        test::with_value(barred, "/terms/0/parameters/pull_out_slip", 0.15 * (1 + 0.04 * warmth));
    for (CampaignRecord& record :
         test::rv_campaign(warm, std::uint64_t(5 + warmth), matrix).records)
      campaign.records.push_back(std::move(record));
  }
  const auto twin = twin_of(nominal(), campaign);
  const auto bar = std::ranges::find(twin->library(), "rotor_bar", &analysis::Candidate::name);
  REQUIRE(bar != twin->library().end());
  const auto effect = std::size_t(bar - twin->library().begin());
  const auto squares = [&](double tried) {
    std::vector<double> values = nominal_values(*twin);
    values.insert(values.end(), {tried, 0});
    return twin->residuals({effect}, values, {true, true, true})->squaredNorm();
  };
  double best = 0;
  for (int percent = 1; percent <= 30; ++percent) {
    if (squares(percent / 100.0) < squares(best)) best = percent / 100.0;
  }
  CHECK(best == Approx(depth).margin(0.011));
  // In each record it is worth more than five standard errors.
  CHECK(squares(0) - squares(best) > 3 * 25);
}

SCENARIO("teeth keep single lines over the angle where a brake's ripple swings the speed",
         "[bench][orders]") {
  if (test::too_long_under_sanitizer()) return;
  // At 150 % the input shaft swings by 0.08 rad about its mean angle, the second harmonic of the
  // mesh by 1.5 rad and the fourth by 3 rad: over time they would fall into sidebands.
  const sim::PlantSpec rippled =
      sim::with_effect(nominal(), "brake_ripple", {.body_a = "brake", .reference = "brake_torque"},
                       {{"depth", {0.02, "1"}}, {"phase", {0.4, "rad"}}, {"per_turn", {1, "1"}}});
  const auto campaign = test::rv_campaign(rippled, 13, two_records());
  const auto farthest = [](const Twin& of, double first, double last) {
    double most = 0;
    for (const auto& cell : of.cells({}, nominal_values(of)).all) {
      if (cell.locked_to != analysis::LockedTo::shaft) continue;
      if (cell.place < first || cell.place > last) continue;
      most = std::max(most, std::abs(cell.apart) / cell.standard_error);
    }
    return most;
  };
  const auto without = twin_of(nominal(), campaign), with = twin_of(rippled, campaign);
  THEN("its own line is off without it only") {
    CHECK(farthest(*without, 0, 1.5 / 121) > 20);
    CHECK(farthest(*with, 0, 1.5 / 121) < 4);
  }
  THEN("lines of the mesh are as without it") {
    CHECK(farthest(*with, 17.8, 17.9) < 4);
    CHECK(farthest(*with, 35.6, 35.8) < 4);
  }
}

TEST_CASE("a hum of the torque channel looks like a force on the shafts, but for its wire",
          "[bench][orders][hum]") {
  if (test::too_long_under_sanitizer()) return;
  const auto twin = twin_of(nominal(), test::rv_campaign(nominal(), 1, two_records()));
  const auto candidate = [&](const std::string& name, const std::string& where) {
    const auto found = std::ranges::find_if(
        twin->library(), [&](const auto& c) { return c.name == name && c.where == where; });
    REQUIRE(found != twin->library().end());
    return *found;
  };
  const auto force = candidate("external_force", "motor against the housing, at 50 Hz");
  CHECK(std::ranges::any_of(force.alike, [](const auto& other) {
    return other.name == "mains_hum" && other.where == "input_torque channel, at 50 Hz";
  }));
  THEN("one of the angle does not show: of the angle only the speed is compared") {
    const auto hum = candidate("mains_hum", "input_angle channel, at 50 Hz");
    CHECK(hum.not_exercised == "changes nothing that these recordings show");
  }
}

SCENARIO("what a steadily turning bench lacks is named, a bench that lacks nothing is left alone",
         "[bench][orders]") {
  if (test::too_long_under_sanitizer()) return;
  // Another unit than the drawing, within its tolerances.
  const sim::PlantSpec machine = test::within_tolerance(nominal(), 11);
  GIVEN("nothing is missing") {
    const auto said = analysis::explain(*twin_of(nominal(), test::rv_campaign(machine, 12)));
    INFO(said.reason);
    CHECK(said.verdict == analysis::ExplainVerdict::null);
    CHECK(said.self_null.found.empty());
  }
  GIVEN("pins of uneven height") {
    const sim::PlantSpec uneven =
        sim::with_effect(machine, "pin_ripple", {"planet_1", "carrier"},
                         {{"pin_error", {0.3e-6, "m"}}, {"pin_phase", {2.2, "rad"}}});
    const auto said = analysis::explain(*twin_of(nominal(), test::rv_campaign(uneven, 13)));
    INFO(said.reason);
    REQUIRE(said.effects.size() == 1);
    CHECK(said.effects[0].name == "pin_ripple");
    const analysis::Estimate& size = said.effects[0].parameters[0];
    CHECK(size.name == "pin_error");
    CHECK(size.value == Approx(0.3e-6).epsilon(0.1));
    CHECK(size.low < 0.3e-6);
    CHECK(size.high > 0.3e-6);
    AND_THEN("how far the pins stand from the first record's zero is not told by amplitudes") {
      const analysis::Estimate& phase = said.effects[0].parameters[1];
      CHECK(phase.name == "pin_phase");
      CHECK(phase.high - phase.low > 1);
    }
  }
}
