#include "bench/junit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/findings_stand.hpp"
#include "bench/limit_checks.hpp"
#include "bench/report/finding_text.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench {
namespace {

enum class CaseOutcome { passed, failure, error, skipped };

struct TestCase {
  std::string group;
  std::string name;
  CaseOutcome result = CaseOutcome::passed;
  std::string message;
};

const char* element_of(CaseOutcome result) {
  switch (result) {
    case CaseOutcome::failure: return "failure";
    case CaseOutcome::error: return "error";
    case CaseOutcome::skipped: return "skipped";
    case CaseOutcome::passed: break;
  }
  return "";
}

TestCase case_of(const JudgedPoint& point) {
  const analysis::Examination& seen = point.examination;
  TestCase test{"points", seen.source, CaseOutcome::passed, ""};
  if (std::isfinite(point.planned_speed_rpm)) {
    test.name = fmt::format("{:.0f} rpm, {:.0f} %, repeat {}", point.planned_speed_rpm,
                            seen.load_pct, seen.repeat);
  }
  if (point.status == not_recorded)
    return {test.group, test.name, CaseOutcome::skipped, "not recorded"};
  if (point.status != "ok") return {test.group, test.name, CaseOutcome::error, point.status};
  for (const analysis::QualityNote& note : seen.quality) {
    if (note.invalidates)
      return {test.group, test.name, CaseOutcome::error, note.where + ": " + note.what};
  }
  if (!seen.resolvable && !seen.of_hysteresis) {
    return {test.group, test.name, CaseOutcome::error,
            fmt::format("not resolvable: {:.2f} periods recorded", seen.periods)};
  }
  return test;
}

TestCase case_of(const LimitCheck& check) {
  TestCase test{"limits", name_of(check), CaseOutcome::passed, ""};
  std::string beyond_it;
  if (is_beyond(check)) {
    beyond_it = fmt::format("{} is {} its {} ({}; {})", with_unit(check.measured, check.unit),
                            beyond(check), bound_text(check), check.where, check.why);
  }
  if (!is_measured(check)) {
    test.result = CaseOutcome::error;
    test.message =
        why_unmeasured(check) + first_lacking(check) + (beyond_it.empty() ? "" : "; " + beyond_it);
  } else if (!beyond_it.empty()) {
    test.result = CaseOutcome::failure;
    test.message = std::move(beyond_it);
  }
  return test;
}

TestCase case_of(const analysis::Finding& finding, const Judgement& judgement) {
  const bool stands = findings_stand(judgement);
  return {"findings", finding.component + ": " + finding.mechanism,
          stands ? CaseOutcome::failure : CaseOutcome::skipped,
          fmt::format("severity {:.3g}, limit {:.3g}; order {:.4g}; {}", finding.severity,
                      finding.limit, finding.order,
                      stands ? finding.advice : report::seen_but(judgement.ending))};
}

TestCase case_of(const Ending& ending) {
  TestCase test{"run", "verdict " + std::string(to_string(ending.outcome)), CaseOutcome::error,
                ending.reason};
  if (ending.outcome == Outcome::pass) test.result = CaseOutcome::passed;
  if (ending.outcome == Outcome::fail) test.result = CaseOutcome::failure;
  return test;
}

std::vector<TestCase> cases_of(const Judgement& judgement) {
  std::vector<TestCase> tests = {case_of(judgement.ending)};
  for (const JudgedPoint& point : judgement.points) tests.push_back(case_of(point));
  for (const LimitCheck& check : judgement.limits) tests.push_back(case_of(check));
  for (const analysis::Finding& finding : judgement.diagnosis.findings)
    tests.push_back(case_of(finding, judgement));
  return tests;
}

std::string xml_of(const TestCase& test) {
  std::string xml = fmt::format(R"(  <testcase classname="rvbench.{}" name="{}")",
                                xml_escaped(test.group), xml_escaped(test.name));
  if (test.result == CaseOutcome::passed) return xml + "/>\n";
  const char* element = element_of(test.result);
  return xml +
         fmt::format("><{} message=\"{}\"/></testcase>\n", element, xml_escaped(test.message));
}

}  // namespace

std::string junit_xml(const Judgement& judgement) {
  const std::vector<TestCase> tests = cases_of(judgement);
  const auto count = [&](CaseOutcome result) {
    return std::ranges::count(tests, result, &TestCase::result);
  };
  const double seconds = std::isfinite(judgement.facts.duration_s) ? judgement.facts.duration_s : 0;
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  xml += fmt::format(
      R"(<testsuite name="rvbench {}" tests="{}" failures="{}" errors="{}" skipped="{}" )"
      R"(time="{:.3f}">)",
      xml_escaped(judgement.facts.serial), tests.size(), count(CaseOutcome::failure),
      count(CaseOutcome::error), count(CaseOutcome::skipped), seconds);
  xml += '\n';
  for (const TestCase& test : tests) xml += xml_of(test);
  return xml + "</testsuite>\n";
}

}  // namespace rvbench::bench
