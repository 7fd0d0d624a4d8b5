#include "bench/judging.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <utility>
#include <vector>

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

// Of two gears in two channels.
JudgedPoint point_with_fm4(double sun, double planet) {
  JudgedPoint point = point_with_peak(0.1);
  point.examination.channels.resize(2, point.examination.channels.front());
  point.examination.channels[0].indicators = {{"fm4", "mesh, sun", 3, "1"},
                                              {"fm4", "mesh, planet", planet, "1"}};
  point.examination.channels[1].name = "accel_1y";
  point.examination.channels[1].indicators = {{"fm4", "mesh, sun", sun, "1"},
                                              {"fm4", "mesh, planet", 3, "1"}};
  return point;
}

Limit least(const std::string& measure, double min) {
  return {measure, "", "1", not_known, "the maker says so", "", min};
}

Judgement concluded(std::vector<JudgedPoint> points, const std::vector<Limit>& limits,
                    const Ending& sequence = measured) {
  Judgement judgement;
  judgement.points = std::move(points);
  conclude(judgement, {}, limits, sequence);
  return judgement;
}

}  // namespace

TEST_CASE("what refuses the data comes before what is only noted of them", "[bench]") {
  JudgedPoint point = point_with_peak(0.1);
  point.examination.quality = {{"a", "speed as given", false}, {"a", "clipped", true}};
  const Judgement judgement = concluded({point}, {});
  CHECK(judgement.ending.outcome == Outcome::invalid);
  REQUIRE(judgement.diagnosis.quality.size() == 2);
  CHECK(judgement.diagnosis.quality.front().what == "clipped");
}

TEST_CASE("a limit in g is held against m/s²", "[bench]") {
  CHECK(concluded({point_with_peak(9.8)}, {peak_in_g}).ending.outcome == Outcome::pass);
  const Judgement above = concluded({point_with_peak(1), point_with_peak(19.6133)}, {peak_in_g});
  CHECK(above.ending.outcome == Outcome::fail);
  CHECK(above.limits.at(0).measured == Approx(2.0));
  CHECK(above.limits.at(0).where == "recording.h5#000, accel_1x");
}

TEST_CASE("a limit on something that was not measured is no pass", "[bench]") {
  JudgedPoint volts = point_with_peak(0.1);
  volts.examination.channels.front().indicators.front().unit = "V";
  CHECK(concluded({volts}, {peak_in_g}).ending.outcome == Outcome::invalid);
}

TEST_CASE("the worst of all points, channels and places counts, and the check says where",
          "[bench]") {
  const std::vector<JudgedPoint> points{point_with_fm4(4, 5), point_with_fm4(9, 6)};
  const Judgement judgement = concluded(points, {limit_on("fm4", 8)});
  CHECK(judgement.ending.outcome == Outcome::fail);
  CHECK(judgement.limits.at(0).measured == 9);
  CHECK(judgement.limits.at(0).where == "recording.h5#000, accel_1y, mesh, sun");
  CHECK(judgement.ending.reason ==
        "fm4 9 above its max 8 at recording.h5#000, accel_1y, mesh, sun");
  CHECK(concluded(points, {limit_on("fm4", 9)}).ending.outcome == Outcome::pass);
}

TEST_CASE("a limit that is narrowed to a gear is deaf to others", "[bench]") {
  const Judgement judgement =
      concluded({point_with_fm4(9, 6)}, {limit_on("fm4", 7, "mesh, planet")});
  CHECK(judgement.ending.outcome == Outcome::pass);
  CHECK(judgement.limits.at(0).measured == 6);
}

TEST_CASE("an indicator that is in no record is no pass", "[bench]") {
  const Judgement judgement = concluded({point_with_fm4(3, 3)}, {limit_on("fm0", 1e9)});
  CHECK(judgement.ending.outcome == Outcome::invalid);
  CHECK(
      judgement.ending.reason ==
      "fm0 could not be measured: no mesh is heard well above the noise, or no angle was measured "
      "that places its lines");
  CHECK(std::isnan(judgement.limits.at(0).measured));
  CHECK(concluded({point_with_fm4(3, 3)}, {limit_on("fm4", 1e9, "mesh, wheel")}).ending.reason ==
        "fm4 of mesh, wheel could not be measured");
}

TEST_CASE("a limit that could not be held against one channel of one point is no pass", "[bench]") {
  JudgedPoint deaf = point_with_fm4(3, 3);
  deaf.examination.source = "recording.h5#001";
  deaf.examination.channels[1].indicators.pop_back();  // the planet's
  const Judgement judgement = concluded({point_with_fm4(3, 3), deaf}, {limit_on("fm4", 8)});
  CHECK(exit_code(judgement.ending) == 20);
  CHECK(judgement.ending.reason ==
        "fm4 could not be measured at 1 of 2 points, first recording.h5#001, accel_1y, mesh, "
        "planet");
  CHECK_FALSE(judgement.limits.at(0).passed);
  CHECK(judgement.limits.at(0).points == 2);
  CHECK(judgement.limits.at(0).measured == 3);
  CHECK(judgement.limits.at(0).lacking ==
        std::vector<std::string>{"recording.h5#001, accel_1y, mesh, planet"});
  // Of the other gear it is held against everything.
  CHECK(concluded({point_with_fm4(3, 3), deaf}, {limit_on("fm4", 8, "mesh, sun")}).ending.outcome ==
        Outcome::pass);
}

TEST_CASE("a value in a unit that leads nowhere is no value", "[bench]") {
  JudgedPoint volts = point_with_peak(0.1);
  volts.examination.channels.front().indicators.front().unit = "V";
  const Judgement judgement = concluded({point_with_peak(0.1), volts}, {peak_in_g});
  CHECK(judgement.ending.reason ==
        "acceleration_peak could not be measured in g at 1 of 2 points, first recording.h5#000, "
        "accel_1x");
}

TEST_CASE(
    "a ratio to a mesh is held where the mesh is heard, and the check says at how many points",
    "[bench]") {
  JudgedPoint heard = point_with_peak(0.1);
  heard.examination.channels.resize(2, heard.examination.channels.front());
  heard.examination.channels[1].indicators = {{"fm0", "mesh, sun", 3, "1"}};  // in one channel
  JudgedPoint silent = point_with_peak(0.1);
  silent.examination.source = "recording.h5#001";
  const Judgement judgement = concluded({heard, silent}, {limit_on("fm0", 4)});
  CHECK(judgement.ending.outcome == Outcome::pass);
  CHECK(coverage_of(judgement.limits.at(0)) == "measured at 1 of 2 points");
  CHECK(concluded({heard, silent}, {limit_on("fm0", 2)}).ending.outcome == Outcome::fail);
  CHECK(concluded({silent}, {limit_on("fm0", 4)}).ending.outcome == Outcome::invalid);
  CHECK(coverage_of(concluded({heard}, {limit_on("fm0", 4)}).limits.at(0)).empty());
}

TEST_CASE("a limit that could not be measured outweighs one that is exceeded, and both are said",
          "[bench]") {
  const std::vector<Limit> limits{limit_on("fm4", 8), limit_on("fm0", 4)};
  const Judgement judgement = concluded({point_with_fm4(9, 6)}, limits);
  CHECK(exit_code(judgement.ending) == 20);
  CHECK(
      judgement.ending.reason ==
      "fm0 could not be measured: no mesh is heard well above the noise, or no angle was measured "
      "that places its lines; beside it fm4 9 above its "
      "max 8 at recording.h5#000, accel_1y, mesh, sun");
}

TEST_CASE("of data that cannot be trusted it is said why, not what is missing for it", "[bench]") {
  JudgedPoint clipped = point_with_peak(0.1);
  clipped.examination.channels.front().indicators.clear();
  clipped.examination.quality = {{"recording.h5#000, accel_1x", "clipped", true}};
  CHECK(concluded({clipped}, {peak_in_g}).ending.reason == "recording.h5#000, accel_1x: clipped");
}

TEST_CASE("a gear is held against the earlier repeats of the same speed and load", "[bench]") {
  const auto point = [](double speed_rpm, double load_pct, double variance) {
    JudgedPoint p = point_with_peak(0.1);
    p.planned_speed_rpm = speed_rpm;
    p.examination.load_pct = load_pct;
    p.examination.channels.front().residuals = {{"mesh, sun", {variance, 3 * variance * variance}}};
    return p;
  };
  const auto na4_at = [](const JudgedPoint& p) {
    for (const auto& i : p.examination.channels.front().indicators) {
      if (i.measure == "na4") return i.value;
    }
    return not_known;
  };
  const std::vector<JudgedPoint> points{point(605, 50, 1), point(605, 100, 9), point(605, 50, 4),
                                        point(1210, 50, 9), point(605, 50, 1)};
  const Judgement judgement = concluded(points, {limit_on("na4", 8)});
  CHECK(std::isnan(na4_at(judgement.points[0])));
  CHECK(std::isnan(na4_at(judgement.points[1])));
  CHECK(na4_at(judgement.points[2]) == Approx(7.68));  // 3·16 over (5/2)²
  CHECK(std::isnan(na4_at(judgement.points[3])));
  CHECK(na4_at(judgement.points[4]) == Approx(0.75));  // 3 over (6/3)²
  CHECK(judgement.ending.outcome == Outcome::pass);
  CHECK(coverage_of(judgement.limits.at(0)) == "measured at 2 of 5 points");
  // Recordings of which no speed was planned are nobody's repeats.
  const Judgement stored = concluded({point(not_known, 50, 1), point(not_known, 50, 4)}, {});
  CHECK(std::isnan(na4_at(stored.points[1])));
}

TEST_CASE("of a limit from below the least value counts", "[bench]") {
  JudgedPoint good = point_with_peak(0.1), poor = point_with_peak(0.1);
  good.examination.indicators = {{"efficiency", "", 0.9, "1"}};
  poor.examination.indicators = {{"efficiency", "", 0.7, "1"}};
  const Judgement judgement = concluded({good, poor}, {least("efficiency", 0.8)});
  CHECK(judgement.ending.reason == "efficiency 0.7 below its min 0.8 at recording.h5#000");
  CHECK(judgement.ending.outcome == Outcome::fail);
  CHECK(concluded({good}, {least("efficiency", 0.8)}).ending.outcome == Outcome::pass);
  CHECK(concluded({point_with_peak(0.1)}, {least("efficiency", 0.8)}).ending.outcome ==
        Outcome::invalid);
}

TEST_CASE("an angle in rad is held against a limit in arcsec", "[bench]") {
  JudgedPoint point = point_with_peak(0.1);
  point.examination.indicators = {{"transmission_error", "", 3e-4, "rad"}};  // 62 arcsec
  Limit limit = limit_on("transmission_error", 60);
  limit.unit = "arcsec";
  CHECK(concluded({point}, {limit}).limits.at(0).measured == Approx(61.88).epsilon(1e-3));
  CHECK(concluded({point}, {limit}).ending.outcome == Outcome::fail);
}

TEST_CASE("a limit is held against the points that its measure is of", "[bench]") {
  const JudgedPoint turned = point_with_peak(1);
  JudgedPoint wound;
  wound.examination.source = "recording.h5#001";
  wound.examination.of_hysteresis = true;
  wound.examination.indicators = {{"lost_motion", "", 0.8, "arcmin"}};
  const Limit lost{"lost_motion", "", "arcmin", 1, "ours"};
  const Judgement judgement = concluded({turned, wound}, {peak_in_g, lost});
  INFO(judgement.ending.reason);
  CHECK(judgement.ending.outcome == Outcome::pass);
  CHECK(judgement.limits.at(0).points == 1);
  CHECK(judgement.limits.at(1).points == 1);
  SECTION("one that lacks it among those is told, of those") {
    JudgedPoint mute = wound;
    mute.examination.source = "recording.h5#002";
    mute.examination.indicators.clear();
    const Judgement lacking = concluded({turned, wound, mute}, {peak_in_g, lost});
    CHECK(lacking.ending.outcome == Outcome::invalid);
    CHECK(lacking.ending.reason ==
          "lost_motion could not be measured in arcmin at 1 of 2 points, first recording.h5#002");
  }
  SECTION("without such a point it is no pass") {
    CHECK(concluded({turned}, {lost}).ending.reason ==
          "lost_motion could not be measured in arcmin");
    CHECK(concluded({wound}, {peak_in_g}).ending.reason ==
          "acceleration_peak could not be measured in g");
  }
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

}  // namespace rvbench::bench
