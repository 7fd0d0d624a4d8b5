#include "analysis/compare/slipping_lines.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/compare/headlines.hpp"
#include "tests/analysis/compare/compared_records.hpp"
#include "tests/analysis/spall.hpp"
#include "tests/support/under_sanitizer.hpp"

// Lines of two parts that slip, of which one changes: that one is named, and no other.
namespace rvbench::analysis {
namespace {

Signature spall_of(const char* component, double order) {
  return test::spall_of(component, order, 4);
}

// A motor with two bearings' races.
Kinematics motor(std::vector<Signature> signatures) {
  Kinematics k;
  k.machine = "motor";
  k.orders = {{"motor shaft", 1, {}, "motor", ""}};
  k.signatures = std::move(signatures);
  return k;
}

// Amplitudes of the harmonics of each part, whose true orders are these, and of their sidebands.
struct Part {
  double order, amplitude;
  int harmonics = 4;
  double at_shaft = 0;  // sidebands at the shaft's speed
};

RecordLevels record(const Kinematics& kinematics, const std::vector<Part>& parts, unsigned seed) {
  const test::OrderSignals signals{.count = 30000};  // 300 turns
  Eigen::VectorXd x = 0.3 * signals.noise(seed) + 0.5 * signals.tone(1, seed);
  for (const Part& part : parts) {
    for (int h = 1; h <= part.harmonics; ++h) {
      x += part.amplitude * signals.tone(h * part.order, unsigned(h) * seed + unsigned(h));
      for (const double side : {-1.0, 1.0}) {
        x += part.at_shaft * signals.tone(h * part.order + side, unsigned(h) * seed + 2 * side);
      }
    }
  }
  Recording heard = signals.recording(x);
  heard.planned_speed_rpm = 1200;
  heard.source = "record " + std::to_string(seed);
  return measure_levels(heard, kinematics, quantities_to_compare(kinematics));
}

Comparison change(const Kinematics& kinematics, const std::vector<Part>& before,
                  const std::vector<Part>& after) {
  std::vector<RecordLevels> a, b;
  for (unsigned i = 0; i < 3; ++i) {
    a.push_back(record(kinematics, before, 10 + i));
    b.push_back(record(kinematics, after, 20 + i));
  }
  return compare(a, b, quantities_to_compare(kinematics));
}

std::vector<std::string> named(const Comparison& comparison, const Kinematics& kinematics) {
  std::vector<std::string> names;
  for (const FamilyHeadline& f : family_headlines(comparison)) {
    names.push_back(kinematics.signatures[f.family].component);
    for (const std::size_t other : f.or_of) {
      names.back() += " or " + kinematics.signatures[other].component;
    }
  }
  return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("of two parts with near lines the one that changed is named", "[analysis]") {
  // 3·3.585 = 10.755 and 2·5.415 = 10.83 lie within each other's slip, and so do others not.
  const Kinematics k = motor({spall_of("inner", 5.415), spall_of("outer", 3.585)});
  const double inner = 5.415 * 0.997, outer = 3.585 * 1.003;
  CHECK(named(change(k, {{inner, 0.3}, {outer, 0.3}}, {{inner, 0.9}, {outer, 0.3}}), k) ==
        Names{"inner"});
  CHECK(named(change(k, {{inner, 0.3}, {outer, 0.3}}, {{inner, 0.3}, {outer, 0.9}}), k) ==
        Names{"outer"});
  CHECK(named(change(k, {{inner, 0.3}}, {{inner, 0.9}}), k) == Names{"inner"});
  CHECK(named(change(k, {}, {{outer, 0.3}}), k) == Names{"outer"});
}

TEST_CASE("further harmonics of an outer race do not lead to the inner one", "[analysis]") {
  // 3·3.585 and 6·3.585 lie within 1 % of 2·5.415 and 4·5.415, and so do their sidebands.
  Signature inner = spall_of("inner", 5.415);
  inner.sidebands = {1};
  const Kinematics k = motor({inner, spall_of("outer", 3.585)});
  const Part small{3.585, 0.1, 6, 0.1}, large{3.585, 0.3, 6, 0.3};
  REQUIRE_FALSE(named(change(k, {small}, {large}), k).empty());
  CHECK(named(change(k, {small}, {large}), k).front() == "outer");
  CHECK(named(change(k, {}, {large}), k).front() == "outer");
  CHECK(named(change(k, {{5.415, 0.1, 4, 0.1}}, {{5.415, 0.3, 4, 0.3}}), k) == Names{"inner"});
}

TEST_CASE("of parts that did not change none is named", "[analysis]") {
  const Kinematics k = motor({spall_of("inner", 5.415), spall_of("outer", 3.585)});
  const std::vector<Part> same = {{5.4, 0.3}, {3.6, 0.3}};
  CHECK(named(change(k, same, same), k).empty());
  CHECK(named(change(k, {}, {}), k).empty());
}

TEST_CASE("of two draws of a part that is found a change is told once in twenty at most",
          "[analysis][null]") {
  const auto repeats = GENERATE(1u, 2u);
  CAPTURE(repeats);
  const Kinematics k = motor({spall_of("outer", 3.585)});
  const std::vector<Quantity> quantities = quantities_to_compare(k);
  // As low as the smallest that the other tests name.
  const std::vector<Part> part = {{3.6, 0.1}};
  constexpr int draws = test::under_sanitizer ? 2 : 60;
  int seen = 0, changed = 0;
  for (unsigned draw = 0; draw < draws; ++draw) {
    std::vector<RecordLevels> a, b;
    for (unsigned i = 0; i < repeats; ++i) {
      a.push_back(record(k, part, 1000 + 4 * draw + i));
      b.push_back(record(k, part, 1002 + 4 * draw + i));
    }
    int told = 0;
    for (const Change& one : compare(a, b, quantities, {.least_dB = 0}).changes) {
      if (!one.seen || !quantities[one.quantity].is_in(0)) continue;
      ++seen;
      told += one.word == ChangeWord::changed ? 1 : 0;
    }
    changed += told > 0 ? 1 : 0;
  }
  CHECK(seen > 0);
  if (test::under_sanitizer) return;
  CHECK(changed <= 0.05 * draws + 3 * std::sqrt(0.05 * draws));
}

TEST_CASE("of parts that are both as good as one another neither is named alone", "[analysis]") {
  const Kinematics k = motor({spall_of("drive end", 5.415), spall_of("fan end", 5.44)});
  for (const std::string& one : named(change(k, {{5.42, 0.3}}, {{5.42, 0.9}}), k)) {
    CHECK(one.find(" or ") != std::string::npos);
  }
  CHECK_FALSE(named(change(k, {{5.42, 0.3}}, {{5.42, 0.9}}), k).empty());
}

TEST_CASE("lines of a cage may be those of an outer race that its balls pass", "[analysis]") {
  const Kinematics k = motor({spall_of("outer", 3.6), spall_of("cage", 0.4)});
  const Comparison c = change(k, {{3.6, 0.3}, {0.4, 0.3}}, {{3.6, 0.3}, {0.4, 0.9}});
  REQUIRE(named(c, k).size() >= 1);
  CHECK(named(c, k).front() == "cage or outer");
  CHECK(named(change(k, {{3.6, 0.3}}, {{3.6, 0.9}}), k) == Names{"outer"});
}

TEST_CASE("a part that turns about as fast as the shaft has no sideband below order 0",
          "[analysis]") {
  // Its slip takes order 1.01 to 0.97, far enough from the shaft's own line, and the sideband at
  // the shaft's speed below 0.
  const Kinematics k = motor({test::spall_of("cage", 1.012, 4, 0.05)});
  const double order = 1.012 * 0.96;
  const Comparison c = change(k, {{order, 0.3}}, {{order, 0.9}});
  CHECK(named(c, k) == Names{"cage"});
}

TEST_CASE("peaks without a part are lent to none", "[analysis]") {
  // Sixty tones anywhere: lines of four harmonics meet some of them at some slip.
  const Kinematics k = motor({spall_of("inner", 5.415), spall_of("outer", 3.585)});
  const test::OrderSignals signals{.count = 30000};
  const auto with_tones = [&](double amplitude, unsigned seed) {
    Eigen::VectorXd x = 0.3 * signals.noise(seed);
    for (int i = 1; i <= 60; ++i) {
      const double order = 1.5 + 22 * std::fmod(i * 0.7548776662, 1.0);
      x += amplitude * signals.tone(order, unsigned(i) + seed);
    }
    Recording heard = signals.recording(x);
    heard.planned_speed_rpm = 1200;
    return measure_levels(heard, k, quantities_to_compare(k));
  };
  std::vector<RecordLevels> a, b;
  for (unsigned i = 0; i < 3; ++i) {
    a.push_back(with_tones(0.1, 30 + i));
    b.push_back(with_tones(0.3, 40 + i));
  }
  CHECK(named(compare(a, b, quantities_to_compare(k)), k).empty());
}

}  // namespace rvbench::analysis
