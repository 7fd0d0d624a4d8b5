#include "bench/report/report.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <random>
#include <regex>

#include "bench/report/order_spectrum.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/bench/report_input.hpp"

namespace rvbench::bench {

using Catch::Matchers::Contains;
using test::chirped;
using test::failed_input;
using test::rv20e;

TEST_CASE("orders follow a shaft that changes its speed", "[bench]") {
  const Recording record = chirped(20);
  const Eigen::VectorXd swing = record.find("input_angle")->samples.array().cos();
  const auto spectrum = order_spectrum(swing, record.channels.front(), record);
  Eigen::Index peak = 0;
  CHECK(spectrum.amplitude.maxCoeff(&peak) == Approx(1).epsilon(0.02));
  CHECK(spectrum.axis(peak) == Approx(1).margin(spectrum.resolution));
}

TEST_CASE("without angle and speed there are no orders", "[bench]") {
  Recording record = chirped(1);
  record.channels.pop_back();
  record.speed_rpm = not_known;
  CHECK_THROWS_AS(order_spectrum(record.channels[0].samples, record.channels[0], record),
                  std::invalid_argument);
}

TEST_CASE("the report shows the lines that decided, and what the article alone would name",
          "[bench]") {
  ReportInput input = failed_input();
  input.kinematics.signatures[0].mechanism = "misalignment";
  input.kinematics.signatures[0].order = 1;
  input.judgement.points.front().examination.scores.resize(1);
  input.kinematics.period_turns = 1;
  const std::string html = make_report(input);
  CHECK_THAT(html, Contains("<h2>What decided</h2>") && Contains("input shaft: accel_1x"));
  CHECK_THAT(html, Contains("by the envelopes of IMF 1 to 5 alone?"));
}

TEST_CASE("the report lists families that no part explains", "[bench]") {
  ReportInput input = failed_input();
  const std::string heading = "Families that look like damage, and that no part explains";
  CHECK_THAT(make_report(input), !Contains(heading));
  input.judgement.diagnosis.unknown = {{.spacing = 1.775, .harmonics = 5, .severity = 0.31}};
  const std::string html = make_report(input);
  REQUIRE_THAT(html, Contains(heading));
  CHECK_THAT(html.substr(html.find(heading)),
             Contains("<td>1.7750</td>") && Contains("bearing-like") && Contains("0.310"));
}

TEST_CASE("the report says why a finding's limit is what it is", "[bench]") {
  ReportInput input = failed_input();
  analysis::Signature& part = input.kinematics.signatures[0];
  analysis::Finding& finding = input.judgement.diagnosis.findings.at(0);
  part.component = finding.component;
  part.mechanism = finding.mechanism;
  part.limit_why = "assumed: shafts are true";
  part.depth_limit = finding.limit = 0.2;
  CHECK_THAT(make_report(input), Contains("<dd>assumed: shafts are true</dd>"));
  part.aligned_limit = finding.limit = 0.1;
  CHECK_THAT(make_report(input), Contains("in phase, as a blow"));
  part.scatter_limit = finding.limit = 0.3;
  CHECK_THAT(make_report(input), Contains("phases of its lines scatter"));
}

TEST_CASE("the report tells the worst of each indicator, where, and what the plan allows",
          "[bench]") {
  ReportInput input = failed_input();
  input.judgement.limits.push_back({"band_rms", "", "m/s²", 1, 1.5, "", false, "", "pin pass"});
  const std::string html = make_report(input);
  CHECK_THAT(html, Contains("<h2>Indicators</h2>"));
  const std::string table = html.substr(html.find("<h2>Indicators</h2>"));
  const std::string row = table.substr(table.find("<td>band_rms"), 400);
  CHECK_THAT(row, Contains("<td>1.5</td>") && Contains("accel_1x, sun-planet mesh") &&
                      Contains("≤ 1 m/s² for pin pass: <b>above</b>"));
  CHECK_THAT(table.substr(table.find("<td>torque_ripple"), 300), Contains("<td>–</td>"));
  for (auto& point : input.judgement.points) {
    point.examination.indicators.clear();
    for (auto& channel : point.examination.channels) channel.indicators.clear();
  }
  input.judgement.limits.clear();
  CHECK_THAT(make_report(input), !Contains("<h2>Indicators</h2>"));
}

TEST_CASE("the worst of an indicator is the worst in one unit, whatever each sensor is in",
          "[bench]") {
  ReportInput input = failed_input();
  auto& channels = input.judgement.points.front().examination.channels;
  channels.resize(1);
  channels.resize(3, channels.front());
  channels[0].indicators = {{"acceleration_rms", "", 5, "m/s²"}};
  channels[1].name = "accel_in_g";
  channels[1].indicators = {{"acceleration_rms", "", 1, "g"}};  // 9.81 m/s²
  channels[2].name = "unknown";
  channels[2].indicators = {{"acceleration_rms", "", 7, "V"}};
  const std::string html = make_report(input);
  const std::string table = html.substr(html.find("<h2>Indicators</h2>"));
  const std::string row = table.substr(table.find("<td>acceleration_rms"));
  CHECK_THAT(row.substr(0, 200), Contains("<td>9.81</td><td>m/s²</td>") && Contains("accel_in_g"));
  const std::string next = row.substr(row.find("<td>acceleration_rms", 1), 200);
  CHECK_THAT(next, Contains("<td>7</td><td>V</td>") && Contains("unknown"));
}

TEST_CASE("the report tells at which points a limit could not be held against anything",
          "[bench]") {
  ReportInput input = failed_input();
  LimitCheck check{"fm4", "", "1", 8, 3, "recording.h5#000, accel_1x, mesh", false, "", "mesh"};
  check.points = 2;
  check.lacking = {"recording.h5#000, accel_1y, mesh"};
  input.judgement.limits = {check};
  CHECK_THAT(make_report(input),
             Contains("could not be measured at 1 of 2 points") && Contains("max 8") &&
                 Contains("fm4 of mesh was not measured at 605 rpm, 100 % load, repeat 1, "
                          "accel_1y, mesh."));
  input.judgement.limits[0].lacking.clear();
  CHECK_THAT(make_report(input), !Contains("not measured") && !Contains("could not be measured"));
}

TEST_CASE("INVALID is told by what makes it so", "[bench]") {
  ReportInput input = failed_input();
  Judgement& judgement = input.judgement;
  judgement.ending = {Outcome::invalid, ErrorKind::none, "x"};
  judgement.points.pop_back();
  const auto told = [&] { return make_report(input); };
  const char* data = "The data cannot be trusted: nothing is said about the unit.";
  const char* limit = "A limit could not be held against the data, so the unit is neither passed";
  const char* part = "Of one part the data do not tell whether it is good";
  SECTION("a limit that could not be measured leaves the findings standing") {
    judgement.limits.front().measured = not_known;
    CHECK_THAT(told(), Contains(limit) && Contains("What was found in the data stands") &&
                           !Contains(data) && !Contains(part));
  }
  SECTION("a part that noise hides is neither good nor bad") {
    judgement.diagnosis.not_shown.front().severity_high = 0.5;  // above its limit
    REQUIRE(judgement.diagnosis.not_shown.front().is_open());
    CHECK_THAT(told(), Contains(part) && !Contains(data) && !Contains(limit));
  }
  SECTION("bad data go before a limit that they left unmeasured") {
    judgement.limits.front().measured = not_known;
    judgement.points.front().examination.quality = {{"accel_1x", "clipped", true}};
    CHECK_THAT(told(), Contains(data) && !Contains(limit));
  }
  SECTION("records too short to part the orders are bad data") {
    judgement.diagnosis.resolvable = false;
    CHECK_THAT(told(), Contains(data));
  }
  SECTION("what the run itself says is bad data") { CHECK_THAT(told(), Contains(data)); }
}

TEST_CASE("an indicator is told in the unit of its limit", "[bench]") {
  ReportInput input = failed_input();
  input.judgement.points.front().examination.channels.front().indicators = {
      {"acceleration_peak", "", 18.633, "m/s²"}};
  CHECK_THAT(
      make_report(input),
      Contains("<td>acceleration_peak</td><td>largest distance from the mean</td><td>1.9</td>"
               "<td>g</td>"));
  input.judgement.limits.clear();
  CHECK_THAT(make_report(input), Contains("<td>18.6</td><td>m/s²</td>"));
}

TEST_CASE("the report says first what the verdict is", "[bench]") {
  const std::string html = make_report(failed_input());
  CHECK(html.find("FAIL") < html.find("input_shaft: misalignment"));
  CHECK(html.find("class=\"verdict fail\"") < html.find("<h2>"));
  for (const char* expected :
       {"Matrix of speed and load", "Findings", "Stiffen, shorten or support", "39/121",
        "Envelope spectrum of IMF 5", "IMF 6", "3.6 / 7.1 / 10.3 Hz", "87.3 / 175.5 / 263.7",
        "Signature", "A-17 &lt;&amp;&quot;", "&lt;quick&gt;"}) {
    INFO(expected);
    CHECK_THAT(html, Contains(expected));
  }
}

TEST_CASE("the matrix trusts a hysteresis test that could tell, and no other", "[bench]") {
  ReportInput input;
  input.kinematics = rv20e();
  input.judgement = test::passed_run();
  const auto boxes = [&](const JudgedPoint& point) {
    input.judgement.points = {point};
    const std::string html = make_report(input);
    const auto map = html.find("<div class=\"map\">");
    REQUIRE(map != std::string::npos);
    return html.substr(map, html.find("<p class=\"note\">", map) - map);
  };
  JudgedPoint wound = test::wound_point();
  CHECK_THAT(boxes(wound), Contains(">loop</span>") && !Contains("spoiled"));
  wound.examination.quality = {{"recording.h5#001", "cannot tell: the output slips", true}};
  CHECK_THAT(boxes(wound), Contains("cell spoiled") && Contains(">data</span>"));
  JudgedPoint brief = test::recorded_point();
  brief.examination.resolvable = false;
  CHECK_THAT(boxes(brief), Contains("cell spoiled") && Contains(">short</span>"));
}

TEST_CASE("the report shows beside each other what four ways find in an envelope", "[bench]") {
  ReportInput input = failed_input();
  input.kinematics.signatures[0].order = 1;
  analysis::Signature quiet;
  quiet.component = "pin_housing";
  quiet.order = 78.0 / 121;
  input.kinematics.signatures.push_back(quiet);
  Recording record = chirped(30);
  Eigen::VectorXd& x = record.channels[0].samples;
  std::mt19937 generator(7);
  std::normal_distribution<double> noise;
  const auto heard_in = [&] {
    input.load = [&](std::size_t) { return std::optional<Recording>(record); };
    const std::string html = make_report(input);
    const auto begin = html.find("Four ways to ask the envelope");
    REQUIRE(begin != std::string::npos);
    return html.substr(begin, html.find("<h2>", begin) - begin);
  };
  SECTION("a swing once per turn, in noise") {
    for (double& sample : x) sample += noise(generator);
    const std::string section = heard_in();
    CHECK_THAT(section, Contains("EMD") && Contains("kurtogram") &&
                            Contains("spectral coherence") && Contains("cepstrum pre-whitening"));
    CHECK_THAT(section, Contains("input shaft") && Contains("1 of 1 (p "));
    CHECK_THAT(section, !Contains("pin housing"));
    CHECK_THAT(section, Contains("Of 1 orders that any way found, EMD found 1."));
  }
  SECTION("nothing but noise") {
    for (double& sample : x) sample = noise(generator);
    CHECK_THAT(heard_in(), Contains("None of them found any of the orders."));
  }
}

TEST_CASE("a record with an angle and no stated speed has its lines marked all the same",
          "[bench]") {
  ReportInput input = failed_input();
  input.kinematics.orders.push_back({"loud mesh", 70, "", "sun_gear", ""});
  input.load = [](std::size_t) {
    Recording record = chirped(4);
    record.speed_rpm = not_known;
    return std::optional<Recording>(std::move(record));
  };
  const std::string html = make_report(input);
  CHECK_THAT(html, Contains("Envelope spectrum of IMF 1") && Contains("loud mesh</text>"));
  // Of what was examined without a speed no order is known.
  for (auto& point : input.judgement.points) point.examination.speed_rpm = not_known;
  CHECK_THAT(make_report(input),
             !Contains("Envelope spectrum of IMF 1") && !Contains("loud mesh</text>"));
}

TEST_CASE("the report needs nothing but itself", "[bench]") {
  const std::string html = make_report(failed_input());
  CHECK_FALSE(std::regex_search(html, std::regex("(src|href) *=|url\\(|@import|<script|https?:")));
  CHECK(html.size() < 3000000);
  CHECK_THAT(html, !Contains("nan"));
}

TEST_CASE("a report without samples, points or findings is still a report", "[bench]") {
  ReportInput input;
  input.judgement.facts.serial = "A18";
  const std::string html = make_report(input);
  CHECK_THAT(html, Contains("ERROR"));
  CHECK_THAT(html, Contains("the run did not end"));
  CHECK_THAT(html, Contains("Nothing could be judged"));
}

}  // namespace rvbench::bench
