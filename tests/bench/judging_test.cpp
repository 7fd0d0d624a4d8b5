#include "bench/judging.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using sequences::Limit;

const Ending measured{Outcome::pass, ErrorKind::none, "everything was measured"};
const Limit peak_in_g{"acceleration_peak", "", "g", 1.0, "healthy units stay near 0.1 g"};

JudgedPoint point_with_peak(double peak_m_s2) {
  JudgedPoint point;
  point.examination.source = "recording.h5#000";
  point.examination.resolvable = true;
  point.examination.channels = {{"accel_1x", "m/s²", 0.1, peak_m_s2, 3, {}, {}}};
  return point;
}

Judgement concluded(std::vector<JudgedPoint> points, const std::vector<Limit>& limits,
                    const Ending& sequence = measured) {
  Judgement judgement;
  judgement.points = std::move(points);
  conclude(judgement, {}, limits, sequence);
  return judgement;
}

}  // namespace

TEST_CASE("a limit in g is held against m/s²", "[bench]") {
  CHECK(concluded({point_with_peak(9.8)}, {peak_in_g}).ending.outcome == Outcome::pass);
  const Judgement above = concluded({point_with_peak(1), point_with_peak(19.6133)}, {peak_in_g});
  CHECK(above.ending.outcome == Outcome::fail);
  CHECK(above.limits.at(0).measured == Approx(2.0));
  CHECK(above.limits.at(0).where == "recording.h5#000, accel_1x");
}

TEST_CASE("a limit on something that was not measured is no pass", "[bench]") {
  JudgedPoint volts = point_with_peak(0.1);
  volts.examination.channels.front().unit = "V";
  CHECK(concluded({volts}, {peak_in_g}).ending.outcome == Outcome::invalid);
}

TEST_CASE("nothing judged is no pass", "[bench]") {
  CHECK(concluded({}, {}).ending.outcome == Outcome::invalid);
}

TEST_CASE("a point that cannot be trusted outweighs a limit that is exceeded", "[bench]") {
  JudgedPoint unsettled = point_with_peak(1);
  unsettled.status = "unsettled";
  const Judgement judgement = concluded({point_with_peak(50), unsettled}, {peak_in_g});
  CHECK(judgement.ending.outcome == Outcome::invalid);
  CHECK_THAT(judgement.ending.reason, Contains("unsettled"));
}

TEST_CASE("how the sequence ended outweighs what was judged", "[bench]") {
  const Ending lost{Outcome::error, ErrorKind::device_lost, "inverter: timeout"};
  CHECK(concluded({point_with_peak(50)}, {peak_in_g}, lost).ending.reason == "inverter: timeout");
  const Ending stopped{Outcome::aborted, ErrorKind::none, "stopped"};
  CHECK(exit_code(concluded({point_with_peak(1)}, {peak_in_g}, stopped).ending) == 50);
}

TEST_CASE("every ending has its exit code", "[bench]") {
  CHECK(exit_code({Outcome::pass, ErrorKind::none, ""}) == 0);
  CHECK(exit_code({Outcome::fail, ErrorKind::none, ""}) == 10);
  CHECK(exit_code({Outcome::invalid, ErrorKind::none, ""}) == 20);
  CHECK(exit_code({Outcome::error, ErrorKind::device_lost, ""}) == 30);
  CHECK(exit_code({Outcome::error, ErrorKind::safety_trip, ""}) == 40);
  CHECK(exit_code({Outcome::aborted, ErrorKind::none, ""}) == 50);
  CHECK(exit_code({Outcome::error, ErrorKind::not_qualified, ""}) == 60);
}

TEST_CASE("a record that is not ok is listed, not examined", "[bench]") {
  Recording record;
  record.source = "recording.h5#007";
  record.status = "samples_lost";
  const JudgedPoint point = judge_point(record, {}, {});
  CHECK(point.status == "samples_lost");
  CHECK(point.examination.source == "recording.h5#007");
  CHECK(point.examination.channels.empty());
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
  CHECK_THAT(faults[0].message, Contains("did you mean \"sun_gear\"?"));
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
}

}  // namespace rvbench::bench
