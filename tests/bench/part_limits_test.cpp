#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "bench/judging.hpp"
#include "bench/limit_checks.hpp"
#include "tests/bench/judged_points.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using sequences::Limit;
using test::limit_on;
using test::measured;
using test::peak_in_g;
using test::point_with_peak;

analysis::Kinematics with_crank() {
  analysis::Kinematics machine;
  analysis::Signature& crank = machine.signatures.emplace_back();
  crank.component = "crank";
  crank.mechanism = "eccentricity";
  crank.order = 0.5;
  crank.depth_limit = 0.2;
  return machine;
}

// Its part in one point, whose squared depth scatters with this deviation.
Judgement of_silent_crank(double smallest_visible, const std::vector<Limit>& limits) {
  const analysis::Kinematics machine = with_crank();
  JudgedPoint point = point_with_peak(0.1);
  point.examination.scores.resize(1);
  point.examination.scores[0].depth2_variance = smallest_visible * smallest_visible;
  point.examination.scores[0].smallest_visible = smallest_visible;
  Judgement judgement;
  judgement.points = {point};
  conclude(judgement, with_limits(machine, limits), limits, measured);
  return judgement;
}

}  // namespace

TEST_CASE("a pass names the part that is within its limit, but not surely", "[bench][limits]") {
  const auto passed_with = [](double depth) {
    JudgedPoint point = point_with_peak(0.1);
    analysis::SignatureScore& score = point.examination.scores.emplace_back();
    score.order = 0.5;
    score.depth = depth;
    score.depth2_variance = 0.005 * 0.005;  // 0.194² is 0.0376, 0.2² is 0.04
    score.log_likelihood_ratio = 100;
    score.p_value = 1e-12;
    score.line_orders = {0.5};
    score.line_depths = {depth};
    score.channel_amplitudes = {depth};
    Judgement judgement;
    judgement.points = {point};
    conclude(judgement, with_crank(), {}, measured);
    REQUIRE(judgement.ending.outcome == Outcome::pass);
    REQUIRE(judgement.diagnosis.below_limit.size() == 1);
    return judgement.ending.reason;
  };
  CHECK(passed_with(0.194) ==
        "no finding above its limit; crank: eccentricity is within its limit, 0.97 of it, but not "
        "surely");
  CHECK(passed_with(0.1) == "no finding above its limit");
}

TEST_CASE("what noise could hide is no pass", "[bench][limits]") {
  const Limit strict{"modulation_depth", "crank", "1", 0.05, "as the maker says"};
  const Judgement quiet = of_silent_crank(0.001, {strict});
  CHECK(quiet.ending.outcome == Outcome::pass);
  CHECK(quiet.limits.at(0).measured == 0);
  CHECK(of_silent_crank(0.02, {}).ending.outcome == Outcome::pass);

  const Judgement noisy = of_silent_crank(0.257, {});
  CHECK(noisy.ending.outcome == Outcome::invalid);
  CHECK(noisy.ending.reason ==
        "cannot tell crank: eccentricity: noise hides depths up to 0.257, its limit is 0.2");
  const Judgement blind = of_silent_crank(0, {});
  CHECK(blind.ending.outcome == Outcome::invalid);
  CHECK(blind.ending.reason ==
        "cannot tell crank: eccentricity: no line of its order 0.5 can be read");
  const Judgement limited = of_silent_crank(0.07, {strict});
  CHECK(limited.ending.outcome == Outcome::invalid);
  CHECK(limited.ending.reason == "modulation_depth of crank could not be measured");
}

TEST_CASE("beside a bad part the limit of one that it hides is no flaw of the data",
          "[bench][limits]") {
  analysis::Kinematics machine = with_crank();
  machine.signatures.push_back(machine.signatures[0]);
  machine.signatures[1].component = "sun_gear";
  machine.signatures[1].order = 0.99;
  JudgedPoint point = point_with_peak(0.1);
  point.examination.scores.resize(2);
  analysis::SignatureScore& bad = point.examination.scores[0];
  bad.order = 0.5;
  bad.depth = 0.5;
  bad.depth2_variance = 1e-6;
  bad.p_value = 1e-12;
  bad.line_orders = {0.5};
  bad.line_depths = bad.channel_amplitudes = {bad.depth};
  analysis::SignatureScore& hidden = point.examination.scores[1];
  hidden.signature = 1;
  hidden.depth2_variance = 0.09;
  hidden.smallest_visible = 0.3;
  const Limit strict{"modulation_depth", "sun_gear", "1", 0.05, "as the maker says"};
  Judgement judgement;
  judgement.points = {point};
  conclude(judgement, with_limits(machine, {strict}), {strict}, measured);
  CHECK(judgement.ending.outcome == Outcome::fail);
  CHECK(std::isnan(judgement.limits.at(0).measured));
  CHECK_FALSE(judgement.limits[0].passed);
}

TEST_CASE("a part's limit holds where its set stands under the other's name", "[bench][limits]") {
  Judgement judgement;
  judgement.diagnosis.resolvable = true;
  analysis::Finding& set = judgement.diagnosis.below_limit.emplace_back();
  set.component = "wheel";
  set.one_of = {"wheel", "pinion"};
  set.severity = 0.3;
  const LimitCheck pinion = check_of({"modulation_depth", "pinion", "1", 0.2, ""}, judgement);
  CHECK(pinion.measured == 0.3);
  CHECK_FALSE(pinion.passed);
}

TEST_CASE("of two unknown families the one beside a mesh is the reason, as it decides",
          "[bench][limits]") {
  Judgement judgement;
  judgement.points = {point_with_peak(0.1)};
  conclude(judgement, analysis::Kinematics{}, {}, measured);
  judgement.diagnosis.unknown = {{.spacing = 1.75, .harmonics = 5},
                                 {.spacing = 2.25, .harmonics = 4, .sidebands = 3}};
  hold_against(judgement, {}, measured);
  CHECK(judgement.ending.outcome == Outcome::invalid);
  CHECK_THAT(judgement.ending.reason, Contains("2.25"));
}

TEST_CASE("a limit on a part that the machine does not have is a fault of the plan", "[bench]") {
  analysis::Kinematics kinematics;
  kinematics.machine = "RV-20E";
  kinematics.signatures.resize(1);
  kinematics.signatures[0].component = "sun_gear";
  const Limit known{"modulation_depth", "sun_gear", "1", 0.1, ""};
  const Limit any{"modulation_depth", "", "1", 0.1, ""};
  const Limit misspelt{"modulation_depth", "sun_geer", "1", 0.1, ""};
  CHECK(limits_on_unknown_parts({known, any, peak_in_g}, kinematics).empty());
  const auto faults = limits_on_unknown_parts({known, misspelt}, kinematics);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].pointer == "/limits/1/component");
  CHECK(faults[0].message ==
        "RV-20E has no \"sun_geer\" (there are: sun_gear), did you mean \"sun_gear\"?");
}

TEST_CASE("a limit on a band or gear that the machine does not have is a fault of the plan",
          "[bench]") {
  analysis::Kinematics machine;
  machine.machine = "gear rig";
  machine.orders = {{"pinion shaft", 1, "", "shaft", ""},
                    {"pinion mesh", 23, "", "pinion", "", true}};
  CHECK(limits_on_unknown_parts(
            {limit_on("band_rms", 1, "pinion mesh"), limit_on("order_level", 1, "pinion shaft"),
             limit_on("sideband_ratio", 1, "pinion mesh at pinion shaft")},
            machine)
            .empty());
  const auto faults = limits_on_unknown_parts(
      {limit_on("band_rms", 1, "pinion mush"), limit_on("kurtosis", 4, "pinion mesh")}, machine);
  REQUIRE(faults.size() == 2);
  CHECK(faults[0].pointer == "/limits/0/of");
  CHECK_THAT(faults[0].message, Contains("gear rig has no band_rms of \"pinion mush\" (there are: "
                                         "below the meshes, pinion mesh, above the meshes)") &&
                                    Contains("did you mean \"pinion mesh\"?"));
  CHECK(faults[1].message == "kurtosis is of no single part of gear rig: leave it out");
}

TEST_CASE("the plan's limits on modulation depth replace those of the kinematics", "[bench]") {
  analysis::Kinematics kinematics;
  for (const char* component : {"input_shaft", "crank"}) {
    analysis::Signature signature;
    signature.component = component;
    signature.depth_limit = 0.5;
    kinematics.signatures.push_back(signature);
  }
  const Limit one{"modulation_depth", "crank", "1", 0.1, "cranks"};
  const Limit all{"modulation_depth", "", "1", 0.3, "all"};
  const auto limited = with_limits(kinematics, {one, all, peak_in_g});
  CHECK(limited.signatures[0].depth_limit == 0.3);
  CHECK(limited.signatures[1].depth_limit == 0.1);
  CHECK(limited.signatures[1].limit_why == "cranks");
  CHECK(with_limits(kinematics, {peak_in_g}).signatures[0].depth_limit == 0.5);
  const Limit looser{"modulation_depth", "crank", "1", 0.5, "cranks may"};
  CHECK(with_limits(kinematics, {all, looser}).signatures[1].depth_limit == 0.3);
}

}  // namespace rvbench::bench
