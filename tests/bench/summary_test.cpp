#include "bench/summary.hpp"

#include <catch2/catch.hpp>
#include <sstream>

#include "bench/twin_check.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/bench/summary_of.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;

// The lines of a brief ending that are about limits.
std::vector<std::string> limits_of_brief(const Judgement& judgement) {
  std::ostringstream out;
  Console console{out, out};
  print_brief(console, judgement, "");
  std::vector<std::string> lines;
  std::istringstream text(out.str());
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("  ")) lines.push_back(line);
  }
  return lines;
}

LimitCheck checked(const char* measure, double measured, double min, double max) {
  LimitCheck check;
  check.measure = measure;
  check.unit = "1";
  check.measured = measured;
  check.min = min;
  check.max = max;
  return check;
}

}  // namespace

TEST_CASE("a brief ending has the findings first, then the three limits nearest to their bounds",
          "[bench]") {
  Judgement judgement = test::failed_run();
  CHECK_THAT(limits_of_brief(judgement).front(), Contains(" 300 %  input_shaft: misalignment"));

  judgement = test::passed_run();
  judgement.diagnosis.below_limit.clear();
  judgement.limits = {checked("crest", 1, not_known, 4), checked("efficiency", 0.8, 0.6, not_known),
                      checked("kurtosis", 4.5, not_known, 5), checked("fm4", 1, not_known, 10)};
  auto lines = limits_of_brief(judgement);
  REQUIRE(lines.size() == 3);
  CHECK_THAT(lines[0], Contains("  90 %  kurtosis: 4.5 (max 5)"));
  CHECK_THAT(lines[1], Contains("  75 %  efficiency: 0.8 (min 0.6)"));
  CHECK_THAT(lines[2], Contains("  25 %  crest: 1 (max 4)"));

  // Bounds of 0 have no share: at the bound it is all of it, beyond it no number.
  judgement.limits = {checked("clipped", 0, not_known, 0), checked("lost", 2, not_known, 0),
                      checked("absent", not_known, not_known, 1)};
  lines = limits_of_brief(judgement);
  REQUIRE(lines.size() == 2);
  CHECK_THAT(lines[0], Contains("   -    lost: 2 (max 0)"));
  CHECK_THAT(lines[1], Contains(" 100 %  clipped: 0 (max 0)"));
}

TEST_CASE("the verdict comes last, where it stays in sight", "[bench]") {
  CHECK_THAT(test::summary_of(test::failed_run()), EndsWith("\nFAIL  input_shaft: misalignment\n"));
  CHECK_THAT(test::summary_of(test::passed_run()),
             EndsWith("\nPASS  no finding above its limit\n"));
}

TEST_CASE("a frequency is told with the speed at which it was seen", "[bench]") {
  const std::string text = test::summary_of(test::failed_run());
  CHECK_THAT(text, Contains("10.08 Hz at 605 rpm"));
  CHECK_THAT(text, Contains("171.56 Hz at 2000 rpm"));  // order 5.147
}

TEST_CASE("a p-value far below any that is known well is not told to the digit", "[bench]") {
  Judgement judgement = test::failed_run();
  CHECK_THAT(test::summary_of(judgement), Contains("; p 1.0e-12"));
  judgement.diagnosis.findings.front().p_value = 1.8e-22;  // as the report has it
  CHECK_THAT(test::summary_of(judgement), Contains("; p < 1e-15") && !Contains("e-22"));
}

TEST_CASE("confidence is told of findings above their limit, and of no others", "[bench]") {
  Judgement judgement = test::failed_run();
  CHECK_THAT(test::summary_of(judgement), Contains("confidence 75 %"));
  judgement.diagnosis.below_limit = judgement.diagnosis.findings;
  judgement.diagnosis.below_limit.front().confidence = 0;
  judgement.diagnosis.findings.clear();
  CHECK_THAT(test::summary_of(judgement), !Contains("confidence"));
}

TEST_CASE("a limit is told as max or min, and where it could not be measured", "[bench]") {
  Judgement judgement = test::failed_run();
  CHECK_THAT(
      test::summary_of(judgement),
      Contains("ABOVE  acceleration_peak: 1.9 g (max 0.5 g) at recording.h5#000, accel_1x\n"));
  LimitCheck& check = judgement.limits.front();
  check = {"efficiency", "", "1", not_known, 0.7, "point 000", false, "", "", 0.8};
  CHECK_THAT(test::summary_of(judgement),
             Contains("BELOW  efficiency: 0.7 (min 0.8) at point 000\n"));
  check.points = 3;
  check.lacking = {"point 001"};
  CHECK_THAT(test::summary_of(judgement),
             Contains("no value efficiency (min 0.8): could not be measured at 1 of 3 points, "
                      "first point 001\n") &&
                 Contains("at point 000; measured at 2 of 3 points\n"));
  check.measured = not_known;
  CHECK_THAT(test::summary_of(judgement),
             Contains("no value efficiency (min 0.8): could not be measured\n"));
}

TEST_CASE("what the teardown came to is told, if it has something to say", "[bench]") {
  Judgement judgement = test::failed_run();
  CHECK_THAT(test::summary_of(judgement), !Contains("teardown"));
  judgement.facts.events.emplace_back(9, "in teardown: the shaft does not stop");
  CHECK_THAT(test::summary_of(judgement), Contains("In teardown: the shaft does not stop"));
}

TEST_CASE("how a run differs from its twin is one line, however often it was judged", "[bench]") {
  Judgement judgement = test::passed_run();
  judgement.facts.events.emplace_back(9, "as its twin rv20e_bench, within its tolerances");
  judgement.facts.events.emplace_back(9, "not compared with its twin: too short");
  CHECK_THAT(test::summary_of(judgement), !Contains("twin"));
  for (const char* order : {"order 1", "order 2"}) {
    judgement.facts.events.emplace_back(9, std::string(differs_from_twin) + " a: " + order);
  }
  CHECK_THAT(test::summary_of(judgement), Contains("The run differs from its twin a: order 2"));
  CHECK_THAT(test::summary_of(judgement), !Contains("order 1"));
}

TEST_CASE("missing result files are named on standard error", "[bench]") {
  std::ostringstream out;
  std::ostringstream err;
  Console console{out, err};
  Judgement judgement = test::failed_run();
  print_unwritten(console, judgement);
  CHECK(err.str().empty());
  judgement.unwritten = {"report.html: No space left on device"};
  print_unwritten(console, judgement);
  CHECK_THAT(err.str(), Contains("not written: report.html: No space left on device"));
  CHECK(out.str().empty());
}

TEST_CASE("a channel that was left out is told as such", "[bench]") {
  Judgement judgement = test::passed_run();
  judgement.diagnosis.quality = {{"accel_3x", "no signal", false, true},
                                 {"accel_1x", "an offset", false, false}};
  const std::string text = test::summary_of(judgement);
  CHECK_THAT(text, Contains("accel_3x: no signal (left out)\n"));
  CHECK_THAT(text, Contains("accel_1x: an offset\n"));
}

}  // namespace rvbench::bench
