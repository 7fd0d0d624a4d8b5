#include "analysis/station/control_rules.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <string>

#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::nelson_rules;
using analysis::rule_signals;
using analysis::western_electric_rules;

namespace {

Eigen::VectorXd of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size()));
}

// Rules that fire at the last point.
std::set<std::string> fired_at_end(const std::vector<double>& values,
                                   const std::vector<analysis::ControlRule>& rules) {
  std::set<std::string> names;
  for (const auto& signal : rule_signals(of(values), rules)) {
    if (signal.at == Eigen::Index(values.size()) - 1) names.insert(std::string(signal.rule->name));
  }
  return names;
}

// Mean number of points until a rule fires, over so many charts of chance alone.
double mean_run(const std::vector<analysis::ControlRule>& rules, int charts, Eigen::Index length) {
  double sum = 0;
  for (int chart = 0; chart < charts; ++chart) {
    const auto signals = rule_signals(test::white_noise(length, unsigned(chart) + 1), rules);
    sum += signals.empty() ? double(length) : double(signals.front().at + 1);
  }
  return sum / charts;
}

}  // namespace

TEST_CASE("each of Nelson's tests sees its own pattern", "[analysis][station]") {
  struct Pattern {
    std::vector<double> values;
    std::set<std::string> fire;
  };
  const std::vector<Pattern> patterns{
      {{0.2, -0.3, 3.1}, {"nelson_1"}},
      {{0.2, -0.3, -3.1}, {"nelson_1"}},
      {{-0.1, 0.5, 0.4, 0.6, 0.2, 0.7, 0.3, 0.6, 0.2, 0.4}, {"nelson_2"}},
      {{-1.2, -0.9, -0.3, 0.2, 0.5, 1.1}, {"nelson_3"}},
      {{1.2, 0.9, 0.3, -0.2, -0.5, -1.1}, {"nelson_3"}},
      {{0.5, -1.2, 0.4, -0.3, 1.2, -0.4, 0.6, -0.7, 1.1, -0.2, 0.3, -0.1, 0.4, -0.6}, {"nelson_4"}},
      {{2.1, 0.3, 2.2}, {"nelson_5"}},
      {{-0.3, 1.2, 1.4, -0.2, 1.1, 1.3}, {"nelson_6"}},
      {{0.1, 0.2, -0.3, -0.5, 0.4, 0.9, -0.1, 0.2, 0.3, -0.4, -0.8, 0.1, 0.6, 0.5, -0.2},
       {"nelson_7"}},
      {{1.2, -1.3, -1.1, 1.5, 1.2, -1.4, -1.2, 1.3}, {"nelson_8"}}};
  for (const Pattern& pattern : patterns) {
    CAPTURE(*pattern.fire.begin());
    CHECK(fired_at_end(pattern.values, nelson_rules()) == pattern.fire);
  }
}

TEST_CASE("what just misses a pattern fires nothing", "[analysis][station]") {
  for (const std::vector<double>& values :
       std::vector<std::vector<double>>{{0.2, 2.9},
                                        {2.1, 0.3, -2.2},  // not on one side
                                        {2.1, 2.2, 0.3},   // complete one point before
                                        {1.2, 1.4, -0.2, -0.1, 1.3},
                                        {0.1, 0.2, 0.3, 0.4, 0.4, 0.5},  // a step that is none
                                        {0.5, 0.4, 0.6, 0.2, 0.7, 0.3, 0.6}}) {
    CAPTURE(values);
    CHECK(fired_at_end(values, nelson_rules()).empty());
    CHECK(fired_at_end(values, western_electric_rules()).empty());
  }
}

TEST_CASE("Western Electric asks for eight on one side, Nelson for nine", "[analysis][station]") {
  const std::vector<double> eight{0.5, 0.4, 0.6, 0.2, 0.7, 0.3, 0.6, 0.2};
  CHECK(fired_at_end(eight, western_electric_rules()) ==
        std::set<std::string>{"western_electric_4"});
  CHECK(fired_at_end(eight, nelson_rules()).empty());
}

TEST_CASE("a signal is told at the point that completed it", "[analysis][station]") {
  const auto signals = rule_signals(of({0, 0.1, 3.5, 0.2, -0.1}), nelson_rules());
  REQUIRE(signals.size() == 1);
  CHECK(signals[0].at == 2);
  CHECK(signals[0].rule->meaning == "beyond 3 sigma");
  CHECK(rule_signals(Eigen::VectorXd(), nelson_rules()).empty());
}

TEST_CASE("false alarms are as rare as others have worked out", "[analysis][station][literature]") {
  // Champ & Woodall, Technometrics 29(4), 393-399 (1987): once in 91.75 points by all four zone
  // rules; by 3 sigma alone once in 1/0.0027 = 370.4. Runs are about as scattered as they are long.
  CHECK(mean_run(western_electric_rules(), 2000, 900) ==
        Approx(91.75).epsilon(4 / std::sqrt(2000.0)));
  const std::vector<analysis::ControlRule> first{western_electric_rules().front()};
  CHECK(mean_run(first, 1000, 3000) == Approx(370.4).epsilon(4 / std::sqrt(1000.0)));
}
