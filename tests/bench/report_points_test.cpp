#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/bench/judgements.hpp"
#include "tests/bench/report_input.hpp"

namespace rvbench::bench {

using Catch::Matchers::Contains;
using test::failed_input;

TEST_CASE("the report shows the lines of each speed, and says whose signals it leaves out",
          "[bench]") {
  ReportInput input = failed_input();
  input.load = {};
  auto& points = input.judgement.points;
  const auto test_at = [&points](std::size_t speeds, const std::vector<double>& loads) {
    points.clear();
    for (std::size_t i = 0; i < speeds; ++i) {
      for (const double load : loads) {
        JudgedPoint& point = points.emplace_back(test::recorded_point());
        point.planned_speed_rpm = 500 + 100 * double(i);
        point.examination.speed_rpm = point.planned_speed_rpm;
        point.examination.load_pct = load;
      }
    }
  };
  SECTION("of three speeds it shows all") {
    test_at(3, {0, 100});
    CHECK_THAT(make_report(input), !Contains("Shown are"));
  }
  SECTION("loads in between are left out") {
    test_at(1, {0, 50, 100});
    CHECK_THAT(make_report(input),
               Contains("Shown are 2 of 3 points: at 500 rpm, the first good record") &&
                   !Contains("None is at"));
  }
  SECTION("of five speeds it shows signals from the lowest to the highest") {
    test_at(5, {0, 100});
    const std::string html = make_report(input);
    CHECK_THAT(html, Contains("found [Hz]<br>500.0 rpm") && Contains("found [Hz]<br>900.0 rpm"));
    CHECK_THAT(html, Contains("Shown are 6 of 10 points: at 500, 700, 900 rpm") &&
                         Contains("None is at 600, 800 rpm.") && Contains("verdict.json"));
  }
  SECTION("of seven speeds at one load it shows six") {
    test_at(7, {100});
    const std::string html = make_report(input);
    CHECK_THAT(html, Contains("Shown are 6 of 7 points") && Contains("None is at 1000 rpm."));
  }
  SECTION("what the verdict has its reasons from is shown, whatever else is") {
    test_at(5, {0, 50, 100});
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i].examination.source = "recording.h5#" + std::to_string(i);
    }
    input.judgement.diagnosis.findings.clear();
    input.judgement.limits.clear();
    LimitCheck broken;
    broken.max = 1;
    broken.measured = 2;
    broken.where = "recording.h5#4, accel_1x";
    SECTION("a limit that was broken where nothing is shown takes the place of another point") {
      input.judgement.limits = {broken};
      CHECK_THAT(make_report(input),
                 Contains("Shown are 6 of 15 points: at 500, 700, 900 rpm") &&
                     Contains("In place of 900 rpm, 100 % load, repeat 1, where a finding or a "
                              "broken limit was read: 600 rpm, 50 % load, repeat 1.") &&
                     Contains("None is at 800 rpm."));
    }
    SECTION("of the same speed rather than of another") {
      broken.where = "recording.h5#7, accel_1x";
      input.judgement.limits = {broken};
      CHECK_THAT(make_report(input), Contains("In place of 700 rpm, 100 % load, repeat 1, where"));
    }
    SECTION("a limit that was kept tells nothing") {
      broken.measured = 0.5;
      input.judgement.limits = {broken};
      CHECK_THAT(make_report(input), Contains("Shown are 6 of 15") && !Contains("broken limit"));
    }
    SECTION("nor does one that was kept wherever it could be measured") {
      broken.measured = 0.5;
      broken.lacking = {"recording.h5#1"};
      input.judgement.limits = {broken};
      CHECK_THAT(make_report(input), Contains("Shown are 6 of 15") && !Contains("broken limit"));
    }
    SECTION("a finding that is read at points which are shown anyway") {
      analysis::Finding& finding = input.judgement.diagnosis.findings.emplace_back();
      finding.points = {"recording.h5#4", "recording.h5#0"};
      CHECK_THAT(make_report(input), Contains("Shown are 6 of 15") && !Contains("broken limit"));
    }
    SECTION("of many the first findings, two at most") {
      for (const char* place : {"recording.h5#4", "recording.h5#10", "recording.h5#7"}) {
        input.judgement.diagnosis.findings.emplace_back().points = {place};
      }
      CHECK_THAT(make_report(input),
                 Contains("600 rpm, 50 % load, repeat 1; 800 rpm, 50 % load, repeat 1.") &&
                     Contains("In place of 900 rpm, 100 % load, repeat 1; "));
    }
    SECTION("what was found in a run that did not come to its end is no reason") {
      input.judgement.ending.outcome = Outcome::aborted;
      input.judgement.diagnosis.findings.emplace_back().points = {"recording.h5#4"};
      CHECK_THAT(make_report(input), Contains("Shown are 6 of 15") && !Contains("broken limit"));
    }
  }
  SECTION("with room left it is shown besides") {
    test_at(1, {0, 50, 75, 100});
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i].examination.source = "recording.h5#" + std::to_string(i);
    }
    input.judgement.limits.clear();
    input.judgement.diagnosis.findings.clear();
    input.judgement.diagnosis.findings.emplace_back().points = {"recording.h5#1"};
    CHECK_THAT(make_report(input),
               Contains("Shown are 2 of 4 points: at 500 rpm") &&
                   Contains("Besides, where a finding or a broken limit was read: 500 rpm, 50 %"));
  }
  SECTION("of records of no plan it shows the first") {
    test_at(8, {100});
    for (JudgedPoint& point : points) point.planned_speed_rpm = not_known;
    CHECK_THAT(make_report(input), Contains("Shown are the first 6 of 8 records."));
  }
  SECTION("of more speeds than can be read it says which are missing") {
    test_at(20, {100});
    const std::string html = make_report(input);
    CHECK_THAT(html, Contains("found [Hz]<br>2000.0 rpm") && !Contains("<br>2100.0 rpm"));
    CHECK_THAT(html, Contains("Shown are the 16 lowest of 20 speeds; the others are 2100.0 to "
                              "2400.0 rpm."));
  }
}

}  // namespace rvbench::bench
