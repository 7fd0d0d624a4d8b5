#include "analysis/evidence/article_rules.hpp"

#include <catch2/catch.hpp>

#include "tests/analysis/reducers.hpp"

using namespace rvbench;
using analysis::article_rules;
using analysis::Diagnosis;
using analysis::Examination;
using analysis::Finding;
using test::rv20e;

namespace {

constexpr double mesh = 1080.0 / 121;

Examination point(const std::vector<double>& orders) {
  Examination e;
  e.resolvable = true;
  e.periods = 4;
  e.channels.resize(1);
  for (const double order : orders) e.channels[0].lines.push_back({order, 20 * order, 1, 1e-9, ""});
  return e;
}

Finding part(const char* component, double order, std::vector<double> line_orders,
             std::vector<double> line_depths) {
  Finding f;
  f.component = component;
  f.order = order;
  f.severity = 0.4;
  f.limit = 0.1;
  f.line_orders = std::move(line_orders);
  f.line_depths = std::move(line_depths);
  return f;
}

Diagnosis shaft_found() {
  Diagnosis d;
  d.findings = {part("input_shaft", 1, {1, 2}, {0.4, 0.2})};
  d.not_shown = {part("sun_gear", 120.0 / 121, {}, {})};
  return d;
}

std::string answer(const std::string& question, const std::vector<Examination>& points,
                   const Diagnosis& d) {
  for (const auto& rule : article_rules(points, d, rv20e())) {
    if (rule.question == question) return rule.answer;
  }
  return "";
}

}  // namespace

TEST_CASE("without a finding the article has nothing to ask", "[analysis][evidence]") {
  CHECK(article_rules({point({1, mesh})}, {}, rv20e()).empty());
}

TEST_CASE("alone the article names the part whose order stands highest in the envelopes",
          "[analysis][evidence]") {
  const std::string asked = "which part, by the envelopes of IMF 1 to 5 alone?";
  Examination e = point({});
  e.scores.resize(rv20e().signatures.size());
  CHECK(answer(asked, {e}, {}) == "none");
  e.scores[1].article_statistic = 40;
  e.scores[2].article_statistic = 60;
  CHECK(answer(asked, {e}, {}) == rv20e().signatures[2].component);
  // In ten channels noise alone may reach as much.
  e.channels.resize(100);
  CHECK(answer(asked, {e}, {}) == "none");
}

TEST_CASE("a fault is stationary if its part's rotation is beside the mesh and by itself",
          "[analysis][evidence]") {
  const std::string asked = "stationary fault?";
  CHECK(answer(asked, {point({1, mesh, mesh - 1})}, shaft_found()) == "yes");
  CHECK(answer(asked, {point({2, 2 * mesh, 2 * mesh + 2})}, shaft_found()) == "yes");
  // Equal planets cancel the mesh itself.
  CHECK(answer(asked, {point({1, mesh - 1})}, shaft_found()) == "yes");
  CHECK(answer(asked, {point({mesh, mesh - 1})}, shaft_found()) == "no");  // no rotation
  CHECK(answer(asked, {point({1, mesh})}, shaft_found()) == "no");         // no sidebands
  CHECK(answer(asked, {point({1, mesh, mesh - 1.5})}, shaft_found()) == "no");
  // The sun's sidebands are not the shaft's.
  CHECK(answer(asked, {point({1, mesh, mesh - 120.0 / 121})}, shaft_found()) == "no");
  // Most of the points must show it.
  CHECK(answer(asked, {point({1, mesh, mesh - 1}), point({}), point({})}, shaft_found()) == "no");
}

TEST_CASE("a line is as far off as the speed that was stated, and no farther where angles are",
          "[analysis][evidence]") {
  const std::string asked = "stationary fault?";
  // Of a shaft 0.02 % slower than stated, the line beside the mesh's double lies 1.7 lines off.
  const double off = 1 - 2e-4;
  Examination stated = point({off, off * (2 * mesh - 1)});
  CHECK(answer(asked, {stated}, shaft_found()) == "yes");
  Examination measured = stated;
  measured.angle_measured = true;
  CHECK(answer(asked, {measured}, shaft_found()) == "no");
}

TEST_CASE("a local fault is not stationary though it has the same lines", "[analysis][evidence]") {
  Diagnosis d;
  d.findings = {part("planet_gear", 40.0 / 121, {0.66, 0.99, 1.32, 1.65, 1.98}, {1, 1, 1, 1, 1})};
  d.findings.front().mechanism = "tooth_damage";
  const auto rules = article_rules({point({40.0 / 121, mesh, mesh - 40.0 / 121})}, d, rv20e());
  REQUIRE(rules.size() == 2);
  CHECK(rules[0].answer == "no");
  CHECK(rules[0].why.find("in 1 of 1 points") != std::string::npos);
  CHECK(rules[1].answer == "local");
}

TEST_CASE("a fault is distributed if it modulates smoothly, local if it strikes",
          "[analysis][evidence]") {
  const std::string asked = "distributed or local?";
  CHECK(answer(asked, {}, shaft_found()) == "cannot tell");  // two harmonics are all it has
  Diagnosis d;
  d.findings = {part("sun_gear", 120.0 / 121, {120.0 / 121, 240.0 / 121}, {0.4, 0.2})};
  d.findings.front().mechanism = "profile_error";
  CHECK(answer(asked, {}, d) == "distributed");
  d.findings = {part("planet_gear", 0.33, {0.66, 0.99, 1.32, 1.65, 1.98}, {1, 1, 1, 1, 1})};
  d.findings.front().mechanism = "tooth_damage";
  CHECK(answer(asked, {}, d) == "local");
  d.findings.front().line_depths.assign(5, 0.0);
  CHECK(answer(asked, {}, d) == "cannot tell");
  d.findings = {part("bearing_inner", 2.16, {2.16}, {1})};
  d.findings.front().mechanism = "spall";
  CHECK(answer(asked, {}, d) == "cannot tell");
}

TEST_CASE("shaft and sun are told apart by what was found", "[analysis][evidence]") {
  const std::string asked = "input-shaft misalignment or sun profile error?";
  Diagnosis d = shaft_found();
  CHECK(answer(asked, {}, d) == "input shaft");
  d.findings.push_back(d.not_shown.front());
  d.not_shown.clear();
  CHECK(answer(asked, {}, d) == "both");
  d.below_limit = {d.findings.front()};
  d.findings.erase(d.findings.begin());
  CHECK(answer(asked, {}, d) == "sun gear");
  d.below_limit.clear();
  CHECK(answer(asked, {}, d).empty());  // a machine without an input shaft
}
