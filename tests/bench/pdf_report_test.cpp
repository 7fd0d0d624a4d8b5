#include "bench/report/pdf/pdf_report.hpp"

#include <catch2/catch.hpp>
#include <regex>

#include "bench/run_results.hpp"
#include "bench/text_file.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::Program;
using rvbench::test::ScratchFolder;

ReportInput input_of(const Judgement& judgement) {
  ReportInput input;
  input.judgement = judgement;
  input.kinematics.machine = judgement.machine;
  analysis::Signature signature;
  signature.depth_limit = 0.2;
  input.kinematics.signatures = {signature};
  input.plan_json = "{ \"name\": \"<quick>\" }";
  input.hashes = {{"plan.json", std::string(64, 'a')},
                  {"recording.h5", std::string(64, 'b')},
                  {"verdict.json", std::string(64, 'c')},
                  {sums_in_report, std::string(64, 'd')}};
  return input;
}

std::string pdf_of(const ReportInput& input) {
  const auto made = make_pdf_report(input);
  REQUIRE(made.index() == 0);
  return std::get<0>(made).bytes;
}

// What a reader that is not ours, poppler, says of it.
std::string read_by(const std::vector<std::string>& reader, const std::string& pdf) {
  const ScratchFolder scratch;
  write_file(scratch / "report.pdf", pdf);
  std::vector<std::string> words{"/usr/bin/env"};
  words.insert(words.end(), reader.begin(), reader.end());
  words.push_back("report.pdf");
  if (reader.front() == "pdftotext") words.push_back("-");
  const rvbench::test::Answer answer = Program(scratch.path(), words).wait();
  INFO(answer.err << " (Debian: poppler-utils)");
  REQUIRE(answer.code == 0);
  return answer.out;
}

// The text of each page.
std::vector<std::string> pages_of(const std::string& pdf) {
  std::vector<std::string> pages(1);
  for (const char c : read_by({"pdftotext", "-layout"}, pdf)) {
    if (c == '\f') {
      pages.emplace_back();
    } else {
      pages.back() += c;
    }
  }
  pages.pop_back();  // each ends with a form feed
  return pages;
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

// A judgement with more to say than a page holds.
Judgement talkative_run() {
  Judgement judgement = test::failed_run();
  for (int i = 0; i < 40; ++i) {
    analysis::Finding finding = test::misaligned_shaft();
    finding.component = "part_" + std::to_string(i);
    finding.advice = "Look at part " + std::to_string(i) + " again and again and again and again.";
    judgement.diagnosis.findings.push_back(finding);
    LimitCheck limit = judgement.limits.front();
    limit.of = "band " + std::to_string(i);
    judgement.limits.push_back(limit);
  }
  for (const double speed_rpm : {605, 1210, 1815}) {
    for (const double load_pct : {0, 25, 50, 75, 100, 125, 150}) {
      for (int repeat = 1; repeat <= 3; ++repeat) {
        JudgedPoint point = test::recorded_point();
        point.planned_speed_rpm = speed_rpm;
        point.examination.load_pct = load_pct;
        point.examination.repeat = repeat;
        judgement.points.push_back(point);
      }
    }
  }
  return judgement;
}

}  // namespace

TEST_CASE("the first page of a report on paper is the verdict", "[bench][pdf]") {
  const auto pages = pages_of(pdf_of(input_of(test::failed_run())));
  REQUIRE(pages.size() >= 2);
  for (const char* expected :
       {"FAIL", "The unit is bad.", "A-17 <&\"'>", "RV-20E", "2026-01-02 03:04:05 UTC", "quick",
        "sim, preset input_shaft", "rvbench 0.1.0 (test)", "1 of 2 recorded",
        "input shaft: misalignment – above its limit, 3.00 times it",
        "Advice: Stiffen, shorten or support the input shaft.", "acceleration_peak", "1.9 g",
        "max 0.5 g", "605 rpm", "No population yet: 0 earlier units", "Signature", "page 1 of"}) {
    INFO(expected);
    CHECK_THAT(pages[0], Contains(expected));
  }
  for (const char hash : {'b', 'c', 'd'}) CHECK_THAT(pages[0], Contains(std::string(64, hash)));
  CHECK_THAT(pages[0], Contains("SHA256SUMS without reports") && !Contains("Indicators"));
}

TEST_CASE("a good unit's page names no bad part", "[bench][pdf]") {
  const auto pages = pages_of(pdf_of(input_of(test::passed_run())));
  CHECK_THAT(pages[0], Contains("PASS") && Contains("The unit is good.") &&
                           Contains("No finding above its limit.") && !Contains("FAIL") &&
                           !Contains("Advice"));
}

TEST_CASE("what was seen in refused data comes without advice", "[bench][pdf]") {
  Judgement judgement = test::failed_run();
  judgement.ending = {Outcome::invalid, ErrorKind::none, "clipped"};
  const auto pages = pages_of(pdf_of(input_of(judgement)));
  CHECK_THAT(pages[0], Contains("INVALID") && Contains("the record is refused: clipped") &&
                           Contains("Not compared with earlier units") && !Contains("Advice"));
}

TEST_CASE("the appendix says what the page of the browser says", "[bench][pdf]") {
  const auto pages = pages_of(pdf_of(input_of(test::failed_run())));
  std::string appendix;
  for (std::size_t i = 1; i < pages.size(); ++i) appendix += pages[i];
  for (const char* expected :
       {"Limits and data quality", "3 samples lost", "Indicators", "band_rms", "torque_ripple",
        "All hypotheses", "sun gear: profile error", "Settings and traceability", "Events", "armed",
        "{ \"name\": \"<quick>\" }", "18446744073709551615"}) {
    INFO(expected);
    CHECK_THAT(appendix, Contains(expected));
  }
  CHECK_THAT(appendix, !Contains("</") && !Contains("&lt;"));
}

TEST_CASE("each page has serial, verdict and its number", "[bench][pdf]") {
  const auto pages = pages_of(pdf_of(input_of(talkative_run())));
  REQUIRE(pages.size() > 3);
  for (std::size_t i = 0; i < pages.size(); ++i) {
    CHECK_THAT(pages[i], Contains("A-17 <&\"'>") && Contains("FAIL") &&
                             Contains("page " + std::to_string(i + 1) + " of " +
                                      std::to_string(pages.size())));
  }
}

TEST_CASE("however much there is to say, the verdict is one page and the rest is not lost",
          "[bench][pdf]") {
  Judgement judgement = talkative_run();
  judgement.ending.reason = "because ";
  for (int i = 0; i < 400; ++i) judgement.ending.reason += "reason" + std::to_string(i) + " ";
  const std::string pdf = pdf_of(input_of(judgement));
  const auto pages = pages_of(pdf);
  REQUIRE(pages.size() > 3);
  // What is behind "…" can still be searched for, so the text alone does not tell that it is cut.
  CHECK_THAT(pages[0], Contains("more above the limit in the appendix") && Contains("Signature"));
  CHECK_THAT(pages[1], Contains("Vibration acceptance report"));
  std::string appendix;
  for (std::size_t i = 1; i < pages.size(); ++i) appendix += pages[i];
  CHECK_THAT(appendix, Contains("reason399") && Contains("part 39: misalignment"));
  CHECK(count_of(appendix, "band 39") > 0);
}

TEST_CASE("no text lies outside of the paper's margins", "[bench][pdf]") {
  Judgement judgement = talkative_run();
  judgement.facts.serial = std::string(300, 'W');
  judgement.facts.plan = std::string(200, 'p');
  judgement.limits.front().why = std::string(20000, 'x');  // a cell higher than a page
  const std::string boxes = read_by({"pdftotext", "-bbox"}, pdf_of(input_of(judgement)));
  const std::regex word(
      R"re(<word xMin="([-\d.]+)" yMin="([-\d.]+)" xMax="([-\d.]+)" yMax="([-\d.]+)">([^<]*)<)re");
  std::size_t words = 0, letters = 0;
  for (std::sregex_iterator at(boxes.begin(), boxes.end(), word), end; at != end; ++at, ++words) {
    const std::smatch& box = *at;
    letters += count_of(box[5], "x");
    if (std::stod(box[1]) > 39 && std::stod(box[3]) < 595 - 38 && std::stod(box[2]) > 20 &&
        std::stod(box[4]) < 842 - 15) {
      continue;
    }
    FAIL_CHECK(box.str());
  }
  CHECK(words > 1000);
  CHECK(letters >= 20000);
}

TEST_CASE("a serial of Chinese characters is set in a font that has them", "[bench][pdf]") {
  Judgement judgement = test::passed_run();
  judgement.facts.serial = "减速器-壹号";
  const auto made = make_pdf_report(input_of(judgement));
  REQUIRE(made.index() == 0);
  INFO("fonts-droid-fallback");
  CHECK_FALSE(std::get<0>(made).lacks_characters);
  CHECK_THAT(pages_of(std::get<0>(made).bytes)[0], Contains("减速器-壹号"));
  CHECK_THAT(read_by({"pdfinfo"}, std::get<0>(made).bytes), Contains("PASS: 减速器-壹号"));
}

TEST_CASE("what no font has is told", "[bench][pdf]") {
  Judgement judgement = test::passed_run();
  judgement.facts.serial = "A\xF3\xB0\x80\x80";  // of private use: U+F0000
  CHECK(std::get<0>(make_pdf_report(input_of(judgement))).lacks_characters);
}

TEST_CASE("the same run makes the same bytes, dated when it began", "[bench][pdf]") {
  const std::string pdf = pdf_of(input_of(test::failed_run()));
  CHECK(pdf == pdf_of(input_of(test::failed_run())));
  const std::string about = read_by({"env", "TZ=UTC", "pdfinfo", "-isodates"}, pdf);
  CHECK_THAT(about, Contains("FAIL: A-17 <&\"'>") && Contains("2026-01-02T03:04:05Z") &&
                        Contains("A4") && !Contains("ModDate"));
  Judgement timeless = test::failed_run();
  timeless.facts.started_utc = "";
  CHECK_THAT(read_by({"env", "TZ=UTC", "pdfinfo", "-isodates"}, pdf_of(input_of(timeless))),
             Contains("1970-01-01"));
}

TEST_CASE("the first page shows a unit among 30, and says so of 7", "[bench][pdf]") {
  ReportInput input = input_of(test::passed_run());
  const UnitNumber number{"acceleration_peak", "", "g", false, 0.284, 0.5};
  std::vector<EarlierUnit> units;
  for (int i = 1; i <= 30; ++i) units.push_back({"E", true, {0.01 * i}});
  input.population = population_of({number}, units);
  CHECK_THAT(pages_of(pdf_of(input))[0], Contains("n = 30 earlier units, 28 of them lower") &&
                                             Contains("this unit 0.284") && Contains("limit 0.5"));
  units.resize(7);
  input.population = population_of({number}, units);
  CHECK_THAT(pages_of(pdf_of(input))[0],
             Contains("No population yet: 7 earlier units") && !Contains("this unit 0.284"));
}

TEST_CASE("a report on paper without points, findings or facts is still one", "[bench][pdf]") {
  const auto pages = pages_of(pdf_of({}));
  CHECK_THAT(pages[0], Contains("ERROR") && Contains("the run did not end") &&
                           Contains("Nothing could be judged"));
}

}  // namespace rvbench::bench
