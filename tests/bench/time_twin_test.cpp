#include "bench/time_twin.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>

#include "analysis/explain/explanation.hpp"
#include "analysis/explain/repeat_against_repeat.hpp"
#include "bench/explanation_json.hpp"
#include "sim/plant_json.hpp"
#include "tests/bench/moved_slide.hpp"
#include "tests/support/under_sanitizer.hpp"

namespace rvbench::bench {
namespace {

using analysis::ExplainVerdict;
using analysis::Explanation;
using Catch::Matchers::Contains;
using test::MovedSlide;

std::unique_ptr<Twin> twin_of(const sim::PlantSpec& plant, const Campaign& campaign) {
  auto made = TimeTwin::make(plant, campaign);
  if (const auto* refusal = std::get_if<1>(&made)) FAIL(refusal->faults.front().message);
  return std::get<0>(std::move(made));
}

Explanation explained(const MovedSlide& slide) {
  return analysis::explain(*twin_of(MovedSlide::plant(), slide.campaign()));
}

std::vector<std::string> names(const Explanation& explanation) {
  std::vector<std::string> all;
  for (const auto& effect : explanation.effects) all.push_back(effect.name);
  return all;
}

double sign(double v) { return v > 0 ? 1 : -1; }

}  // namespace

TEST_CASE("nothing is named where the plant says it all", "[bench][explain][null]") {
  for (unsigned seed = 1; seed <= (test::under_sanitizer ? 1 : 5); ++seed) {
    MovedSlide slide;
    slide.seed = seed;
    const Explanation found = explained(slide);
    INFO(found.reason);
    CHECK(found.verdict == ExplainVerdict::null);
    REQUIRE(found.base.size() == 2);
    CHECK(found.base[0].value == Approx(3).epsilon(0.002));
    CHECK(found.base[1].value == Approx(8).epsilon(0.02));
  }
}

TEST_CASE("dry friction is named, with its size, and nothing after it", "[bench][explain]") {
  if (test::too_long_under_sanitizer()) return;
  MovedSlide slide;
  slide.law = [](double, double v) { return 2.5 * sign(v); };
  const Explanation found = explained(slide);
  INFO(found.reason);
  REQUIRE(names(found) == std::vector<std::string>{"coulomb_friction"});
  const analysis::ExplainedEffect& friction = found.effects[0];
  CHECK(friction.verdict == ExplainVerdict::named);
  CHECK(friction.where == "slide against the housing");
  CHECK(friction.parameters[0].unit == "N");
  CHECK(friction.parameters[0].value == Approx(2.5).epsilon(0.05));
  CHECK(friction.share_won > 0.95);
  CHECK(found.held_out_after < 0.3 * found.held_out_before);
  CHECK(found.self_null.known);
  CHECK(found.self_null.found.empty());
}

TEST_CASE("a hardening spring is named as a cubic stiffness", "[bench][explain]") {
  MovedSlide slide;
  slide.length_s = 3;
  slide.law = [](double q, double) { return 900 * q * q * q; };
  const Explanation found = explained(slide);
  INFO(found.reason);
  REQUIRE(names(found) == std::vector<std::string>{"cubic_stiffness"});
  CHECK(found.effects[0].parameters[0].value == Approx(900).epsilon(0.05));
}

TEST_CASE("two laws left out together are named as two", "[bench][explain]") {
  if (test::too_long_under_sanitizer()) return;
  MovedSlide slide;
  slide.law = [](double q, double v) { return 2.5 * sign(v) + 900 * q * q * q; };
  auto found = names(explained(slide));
  std::ranges::sort(found);
  CHECK(found == std::vector<std::string>{"coulomb_friction", "cubic_stiffness"});
}

TEST_CASE("the updated plant leaves nothing to explain", "[bench][explain]") {
  if (test::too_long_under_sanitizer()) return;
  MovedSlide slide;
  slide.law = [](double, double v) { return 2.5 * std::tanh(v / 0.005); };  // contacts creep
  const auto twin = twin_of(MovedSlide::plant(), slide.campaign());
  const Explanation found = analysis::explain(*twin);
  const auto& fit = found.selection.fit;
  const auto updated = sim::parse_plant(hal::ConfigReader::from_text(
      sim::write_plant(twin->plant_with(fit.effects, fit.values)), "plant_updated.json"));
  REQUIRE(updated.index() == 0);
  slide.seed = 2;  // another day
  const Explanation again = analysis::explain(*twin_of(std::get<0>(updated), slide.campaign()));
  INFO(again.reason);
  CHECK(again.verdict == ExplainVerdict::null);
}

TEST_CASE("what brakes one way only is told from dry friction where the weight is known",
          "[bench][explain]") {
  if (test::too_long_under_sanitizer()) return;
  MovedSlide slide;
  slide.law = [](double, double v) { return 4 + (v > 0 ? 2.5 : 0); };
  sim::PlantSpec plant = MovedSlide::plant();
  plant.outputs[0].offset = {4.1, "N", 5};
  const Explanation found = analysis::explain(*twin_of(plant, slide.campaign()));
  INFO(found.reason);
  REQUIRE(names(found) == std::vector<std::string>{"asymmetric_friction"});
  CHECK(found.effects[0].parameters[0].value == Approx(2.5).epsilon(0.05));
  REQUIRE(found.nuisances.size() == 1);
  CHECK(found.nuisances[0].value == Approx(4).epsilon(0.02));
}

TEST_CASE("a transducer wrong by half is no physics", "[bench][explain]") {
  MovedSlide slide;
  slide.gain = 1.5;
  const Explanation found = explained(slide);
  INFO(found.reason);
  CHECK(found.verdict == ExplainVerdict::miscalibrated);
  CHECK_THAT(found.reason, Contains("/bodies/0/mass"));
}

TEST_CASE("what drifts from one repeat to the other is told", "[bench][explain]") {
  MovedSlide slide;
  slide.drift_N = 1;
  const Explanation found = explained(slide);
  CHECK(names(found).empty());
  REQUIRE(found.self_null.known);
  REQUIRE(found.self_null.found.size() == 1);
  // An offset of the transducer and a constant force on the slide are one and the same here.
  CHECK(found.self_null.found[0].unit == "N");
  CHECK(found.self_null.found[0].value == Approx(0.6).epsilon(0.1));
}

TEST_CASE("repeats cut from one recording are compared at the same time of their programme",
          "[bench][explain]") {
  // The first repeat begins its file, the last has samples before it and ends early: what differs
  // is nothing, if the two are laid upon each other rightly.
  const auto cycles = [](Eigen::Index from, Eigen::Index to) {  // of 500 samples, 1 s
    CampaignRecord record = MovedSlide().campaign().records[0];
    Eigen::VectorXd way(to - from), force(to - from);
    for (Eigen::Index i = from; i < to; ++i) {
      const double phase = 2 * M_PI * static_cast<double>(i) / 500, v = std::cos(phase);
      way[i - from] = 0.1 * std::sin(phase);
      force[i - from] = 5 * v + 2.5 * sign(v);
    }
    record.recording.channels[0].samples = way;
    record.recording.channels[1].samples = force;
    return record;
  };
  Campaign cut;
  cut.records = {cycles(0, 3000), cycles(-500, 2900)};
  cut.records[1].name = "again";
  cut.records[1].lead_in = 500;
  const auto twin = twin_of(MovedSlide::plant(), cut);
  const std::vector<bool> everything(twin->units().size(), true);
  analysis::Fit base;
  base.values = {3, 8, 0};
  base.residuals = *twin->residuals({}, base.values, everything);
  const auto repeats = analysis::RepeatAgainstRepeat::make(*twin, base);
  REQUIRE(repeats);
  const auto apart = repeats->residuals({}, {}, std::vector<bool>(repeats->units().size(), true));
  REQUIRE(apart);
  CHECK(base.residuals.norm() > 1);
  CHECK(apart->norm() < 1e-3 * base.residuals.norm());
}

TEST_CASE("of one condition nothing can be left out, and nothing is named", "[bench][explain]") {
  Campaign campaign = MovedSlide().campaign();
  for (CampaignRecord& record : campaign.records) record.condition = "the only one";
  const auto twin = twin_of(MovedSlide::plant(), campaign);
  const Explanation found = analysis::explain(*twin);
  CHECK(found.verdict == ExplainVerdict::not_resolvable);
  CHECK(found.effects.empty());
  CHECK(record_errors(*twin, found.selection, compare(*twin, found.selection)).empty());
}

TEST_CASE("a force that hardly changes about a large mean is not of something else",
          "[bench][explain]") {
  // 0.5 N of friction about 40 N of weight that the plant file does not have, and cannot: its
  // offset is known. It is off by many times what the force changes by; no model at all, by more.
  MovedSlide slide;
  slide.length_s = 3;
  Campaign campaign = slide.campaign();
  for (CampaignRecord& record : campaign.records) {
    auto& channels = record.recording.channels;
    const double scale = 1e-2;
    channels[0].samples *= scale;
    channels[1].samples = (scale * channels[1].samples).array() + 40;
  }
  sim::PlantSpec plant = MovedSlide::plant();
  plant.outputs[0].offset = {38, "N", 0};
  const auto twin = twin_of(plant, campaign);
  CHECK(twin->nothing_predicted() > 100);
  const Explanation found = analysis::explain(*twin);
  INFO(found.reason);
  CHECK(found.verdict != ExplainVerdict::not_resolvable);
}

TEST_CASE("recordings that do not fit the plant are refused, with the place", "[bench][explain]") {
  const auto refusal = [](const std::function<void(Channel & way, Channel & force)>& spoil) {
    Campaign campaign = MovedSlide().campaign();
    auto& channels = campaign.records[2].recording.channels;
    spoil(channels[0], channels[1]);
    const auto made = TimeTwin::make(MovedSlide::plant(), campaign);
    REQUIRE(made.index() == 1);
    CHECK(std::get<1>(made).of_recordings);
    const hal::ConfigFault& fault = std::get<1>(made).faults.front();
    return fault.pointer + ": " + fault.message;
  };
  CHECK_THAT(refusal([](Channel&, Channel& force) { force.info.name = "load"; }),
             Contains("/outputs/0/channel: record 3: \"force\" is no channel"));
  CHECK_THAT(refusal([](Channel&, Channel& force) { force.info.unit = "V"; }),
             Contains("\"force\" is in V, the plant shows N"));
  CHECK_THAT(refusal([](Channel&, Channel& force) {
               force.samples[100] = std::numeric_limits<double>::quiet_NaN();
             }),
             Contains("not finite"));
  CHECK_THAT(refusal([](Channel&, Channel& force) {
               force.samples = force.samples.cwiseMin(3).cwiseMax(-3);
             }),
             Contains("clipped"));
  CHECK_THAT(refusal([](Channel& way, Channel& force) {
               way.samples = Eigen::VectorXd(way.samples.head(50));
               force.samples = Eigen::VectorXd(force.samples.head(50));
             }),
             Contains("too short"));
  CHECK_THAT(refusal([](Channel& way, Channel&) { way.info.name = "angle"; }),
             Contains("record 3") && Contains("way"));
}

TEST_CASE("where nothing reverses, friction of one direction looks like Coulomb's",
          "[bench][explain]") {
  Campaign campaign = MovedSlide().campaign();
  for (CampaignRecord& record : campaign.records) {
    Eigen::VectorXd& way = record.recording.channels[0].samples;
    way += Eigen::VectorXd::LinSpaced(way.size(), 0, 5 * MovedSlide().length_s);  // 5 m/s on top
  }
  const auto found = [](const Twin& twin, const char* name) {
    return *std::ranges::find(twin.library(), name, &analysis::Candidate::name);
  };
  const auto one_way = twin_of(MovedSlide::plant(), campaign);
  CHECK(found(*one_way, "asymmetric_friction").not_exercised ==
        "the direction of motion never changes");
  const analysis::Candidate coulomb = found(*one_way, "coulomb_friction");
  REQUIRE(coulomb.alike.size() == 1);
  CHECK(coulomb.alike.front().name == "asymmetric_friction");
  CHECK(coulomb.not_exercised.empty());

  const auto both_ways = twin_of(MovedSlide::plant(), MovedSlide().campaign());
  CHECK(found(*both_ways, "asymmetric_friction").not_exercised.empty());
  CHECK(found(*both_ways, "coulomb_friction").alike.empty());
}

}  // namespace rvbench::bench
