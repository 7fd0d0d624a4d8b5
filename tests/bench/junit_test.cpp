#include "bench/junit.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <regex>
#include <vector>

#include "tests/bench/judgements.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;

// Tags balance, attributes are quoted and hold no bare markup: enough of XML for what we write.
bool is_well_formed(const std::string& xml) {
  static const std::regex tag(R"re(<(/?)([a-z]+)((?: [a-z]+="[^"<]*")*)(/?)>)re");
  std::vector<std::string> open;
  std::string rest = xml.substr(xml.find("?>") + 2);
  std::smatch match;
  while (std::regex_search(rest, match, tag)) {
    const std::string before = match.prefix();
    if (before.find_first_of("<>") != std::string::npos) return false;
    if (match[1].length() == 1) {
      if (open.empty() || open.back() != match[2]) return false;
      open.pop_back();
    } else if (match[4].length() == 0) {
      open.push_back(match[2]);
    }
    rest = match.suffix();
  }
  return open.empty() && rest.find_first_of("<>") == std::string::npos;
}

}  // namespace

TEST_CASE("junit.xml is well formed whatever the names are", "[bench]") {
  const std::string xml = junit_xml(test::failed_run());
  INFO(xml);
  CHECK(is_well_formed(xml));
  CHECK_FALSE(is_well_formed(xml + "</testsuite>"));
  CHECK_THAT(xml, Contains("A-17 &lt;&amp;&quot;'&gt;"));
}

TEST_CASE("junit.xml maps points, limits and findings", "[bench]") {
  const std::string xml = junit_xml(test::failed_run());
  CHECK_THAT(xml, Contains(R"(tests="5" failures="3" errors="0" skipped="1" time="123.500")"));
  CHECK_THAT(xml, Contains(R"(name="605 rpm, 100 %, repeat 1"/>)"));
  CHECK_THAT(xml, Contains(R"(name="1210 rpm, 50 %, repeat 2"><skipped message="not recorded"/>)"));
  CHECK_THAT(
      xml, Contains(R"(name="acceleration_peak"><failure message="1.9 g is above its max 0.5 g)"));
  CHECK_THAT(xml, Contains(R"(name="input_shaft: misalignment"><failure)"));
}

TEST_CASE("a limit that could not be measured is an error, and what it exceeds is said",
          "[bench]") {
  Judgement judgement = test::passed_run();
  judgement.limits.front().points = 3;
  judgement.limits.front().lacking = {"recording.h5#001, accel_1x"};
  judgement.limits.front().measured = 1.9;
  CHECK_THAT(junit_xml(judgement),
             Contains(R"(<error message="could not be measured in g at 1 of 3 points, first )"
                      "recording.h5#001, accel_1x; 1.9 g is above its max 0.5 g"));
  judgement.limits.front().measured = not_known;
  CHECK_THAT(junit_xml(judgement), Contains(R"(<error message="could not be measured in g"/>)"));
}

TEST_CASE("a good unit has no failure in junit.xml", "[bench]") {
  CHECK_THAT(junit_xml(test::passed_run()), Contains(R"(failures="0" errors="0" skipped="0")"));
}

TEST_CASE("a hysteresis test needs no periods to pass, and is an error when it cannot tell",
          "[bench]") {
  Judgement judgement = test::passed_run();
  judgement.points = {test::wound_point()};
  CHECK_THAT(junit_xml(judgement), Contains(R"(name="30 rpm, 125 %, repeat 1"/>)") &&
                                       Contains(R"(failures="0" errors="0" skipped="0")"));
  judgement.points[0].examination.quality = {{"recording.h5#001", "cannot tell: it slips", true}};
  CHECK_THAT(junit_xml(judgement),
             Contains(R"(<error message="recording.h5#001: cannot tell: it slips"/>)"));
  JudgedPoint turned = test::recorded_point();
  turned.examination.resolvable = false;
  judgement.points = {turned};
  CHECK_THAT(junit_xml(judgement), Contains("not resolvable: 4.20 periods"));
}

TEST_CASE("an ending that is the bench's fault is an error, not a failure", "[bench]") {
  Judgement judgement = test::passed_run();
  judgement.ending = {Outcome::error, ErrorKind::device_lost, "inverter: timeout"};
  CHECK_THAT(junit_xml(judgement),
             Contains(R"(name="verdict ERROR"><error message="inverter: timeout"/>)"));
  judgement.ending = {Outcome::pass, ErrorKind::none, ""};
  judgement.points.front().status = "unsettled";
  CHECK_THAT(junit_xml(judgement), Contains(R"(<error message="unsettled"/>)"));
}

}  // namespace rvbench::bench
