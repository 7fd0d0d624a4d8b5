#include "analysis/compare/comparison.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "analysis/compare/headlines.hpp"
#include "analysis/indicators/signal_levels.hpp"
#include "analysis/statistics.hpp"
#include "tests/analysis/compare/compared_records.hpp"
#include "tests/analysis/spall.hpp"
#include "tests/support/under_sanitizer.hpp"

// What is said of records whose difference is known.
namespace rvbench::analysis {
namespace {

using Catch::Matchers::Contains;
using test::change_of;
using test::compared;
using test::GearRecord;
using test::repeats;

constexpr double doubled_dB = 6.0206;

bool is_told(const Comparison& comparison, const std::string& why) {
  return std::ranges::any_of(comparison.left_out, [&](const NotCompared& out) {
    return (out.where + ": " + out.why).find(why) != std::string::npos;
  });
}

std::vector<std::string> names_of_changed_lines(const Comparison& comparison) {
  std::vector<std::string> names;
  for (const Headline& h : headlines(comparison)) {
    const Quantity& q = comparison.quantities[h.quantity];
    if (q.is_line()) names.push_back(q.name);
  }
  return names;
}

}  // namespace

SCENARIO("a line that doubled is told by 6 dB and by name", "[analysis]") {
  GIVEN("three repeats of a gear, and three with twice the mesh") {
    const Comparison c =
        compared(repeats({.scatter_dB = 0.1}, 3, 1), repeats({.mesh = 2, .scatter_dB = 0.1}, 3, 2));
    THEN("the mesh changed by 6 dB within the uncertainty that is stated") {
      const Change& mesh = *change_of(c, "mesh");
      CHECK(mesh.word == ChangeWord::changed);
      CHECK(mesh.source == ScatterSource::repeats);
      CHECK(std::abs(mesh.change_dB - doubled_dB) < mesh.uncertainty_dB);
      CHECK(mesh.uncertainty_dB < 0.7);
      CHECK(mesh.a_dB == Approx(0).margin(0.3));  // 1 m/s²
    }
    THEN("the line that stayed did not change, and what would have been seen is told") {
      const Change& shaft = *change_of(c, "input shaft");
      CHECK(shaft.word == ChangeWord::not_changed);
      CHECK(shaft.detectable_dB < 3);
      CHECK(std::abs(shaft.change_dB) < shaft.detectable_dB);
    }
    THEN("no other line is named, as none is there") {
      CHECK(names_of_changed_lines(c) == std::vector<std::string>{"mesh"});
      CHECK_FALSE(change_of(c, "mesh x2")->seen);
    }
    THEN("the level rose by what the mesh adds to it") {
      // A: 0.5²/2 + 1/2 + 0.09; B: 0.5²/2 + 4/2 + 0.09
      CHECK(change_of(c, "rms")->change_dB == Approx(10 * std::log10(2.215 / 0.715)).margin(0.15));
      CHECK(word_of(counts_of(c)) == ChangeWord::changed);
    }
  }
}

TEST_CASE("the stated uncertainty holds the true change in 95 of 100 cases", "[analysis]") {
  if (test::too_long_under_sanitizer()) return;
  int held = 0;
  double width_dB = 0;  // mean
  constexpr unsigned draws = 60;
  for (unsigned seed = 0; seed < draws; ++seed) {
    const Comparison c =
        compared(repeats({.scatter_dB = 0.3, .count = 7000}, 3, 2 * seed),
                 repeats({.mesh = 2, .scatter_dB = 0.3, .count = 7000}, 3, 2 * seed + 1));
    const Change& mesh = *change_of(c, "mesh");
    held += std::abs(mesh.change_dB - doubled_dB) < mesh.uncertainty_dB ? 1 : 0;
    width_dB += mesh.uncertainty_dB / draws;
  }
  CHECK(held >= 51);  // 57 expected; fewer than 51 of 60 by chance once in 300
  // Nor is it wide for safety: t(0.05) of four degrees of freedom is 2.776, and the mean of s 0.94
  // of the scatter, give or take 0.04 in 60 draws; what other cells say can only make it narrower.
  CHECK(width_dB < 2.776 * (0.94 + 3 * 0.045) * 0.3 * std::sqrt(2.0 / 3));
}

TEST_CASE("B against A is A against B with the sign turned", "[analysis]") {
  const auto a = repeats({.scatter_dB = 0.2}, 3, 1),
             b = repeats({.mesh = 3, .scatter_dB = 0.2}, 3, 2);
  const Comparison forth = compared(a, b), back = compared(b, a);
  REQUIRE(forth.changes.size() == back.changes.size());
  for (std::size_t i = 0; i < forth.changes.size(); ++i) {
    REQUIRE(forth.changes[i].change_dB == Approx(-back.changes[i].change_dB).margin(1e-9));
    REQUIRE(forth.changes[i].word == back.changes[i].word);
  }
}

TEST_CASE("in another unit of measurement nothing but the levels differs", "[analysis]") {
  const auto scaled = [](std::vector<Recording> records) {
    for (Recording& record : records) record.channels.front().samples *= 1e-6;
    return records;
  };
  const auto a = repeats({.scatter_dB = 0.2}, 3, 1),
             b = repeats({.mesh = 2, .scatter_dB = 0.2}, 3, 2);
  const Comparison one = compared(a, b), other = compared(scaled(a), scaled(b));
  REQUIRE(one.changes.size() == other.changes.size());
  for (std::size_t i = 0; i < one.changes.size(); ++i) {
    REQUIRE(one.changes[i].change_dB == Approx(other.changes[i].change_dB).margin(1e-6));
    REQUIRE(one.changes[i].word == other.changes[i].word);
  }
  CHECK(change_of(other, "mesh")->a_dB == Approx(change_of(one, "mesh")->a_dB - 120).margin(1e-6));
}

TEST_CASE("a sensor that reads double moves every line alike, and no shape", "[analysis]") {
  auto b = repeats({.scatter_dB = 0.1}, 3, 2);
  for (Recording& record : b) record.channels.front().samples *= 2;
  const Comparison c = compared(repeats({.scatter_dB = 0.1}, 3, 1), b);
  for (const char* name : {"rms", "peak", "mesh", "input shaft"}) {
    CAPTURE(name);
    CHECK(change_of(c, name)->word == ChangeWord::changed);
    CHECK(change_of(c, name)->change_dB == Approx(doubled_dB).margin(0.5));
  }
  for (const char* name : {"crest factor", "kurtosis"}) {
    CHECK(change_of(c, name)->word == ChangeWord::not_changed);
  }
}

TEST_CASE("of one record each the parts of it tell the scatter, and that is said", "[analysis]") {
  const Comparison c = compared(repeats({}, 1, 1), repeats({.mesh = 2}, 1, 2));
  const Change& mesh = *change_of(c, "mesh");
  CHECK(mesh.source == ScatterSource::parts);
  CHECK(mesh.word == ChangeWord::changed);
  CHECK(std::abs(mesh.change_dB - doubled_dB) < mesh.uncertainty_dB);
  CHECK(change_of(c, "rms")->source == ScatterSource::parts);
  CHECK(change_of(c, "input shaft")->word == ChangeWord::not_changed);
}

TEST_CASE("of one record each the levels told are those of the records", "[analysis]") {
  const GearRecord of{.noise = 1};
  const Recording a = test::gear_record(of, 1), b = test::gear_record(of, 2);
  const Comparison c = compared({a}, {b});
  const SignalLevels in_a = signal_levels(a.channels.front().samples);
  const SignalLevels in_b = signal_levels(b.channels.front().samples);
  const auto dB = [](double level) { return Approx(20 * std::log10(level)).margin(1e-9); };
  CHECK(change_of(c, "peak")->source == ScatterSource::parts);
  CHECK(change_of(c, "peak")->a_dB == dB(in_a.peak));
  CHECK(change_of(c, "peak")->b_dB == dB(in_b.peak));
  CHECK(change_of(c, "crest factor")->a_dB == dB(in_a.crest_factor));
  CHECK(change_of(c, "kurtosis")->b_dB == dB(in_b.kurtosis));
}

TEST_CASE("one record against three takes the scatter of the three", "[analysis]") {
  const Comparison c =
      compared(repeats({.scatter_dB = 0.1}, 3, 1), repeats({.mesh = 2, .scatter_dB = 0.1}, 1, 2));
  const Change& mesh = *change_of(c, "mesh");
  CHECK(mesh.source == ScatterSource::repeats);
  CHECK(mesh.change_dB == Approx(doubled_dB).margin(0.6));
}

TEST_CASE("where scatter is large it cannot be told whether something changed", "[analysis]") {
  const Comparison c = compared(repeats({.scatter_dB = 4}, 2, 1), repeats({.scatter_dB = 4}, 2, 2));
  const Change& mesh = *change_of(c, "mesh");
  CHECK(mesh.word == ChangeWord::cannot_tell);
  CHECK(mesh.detectable_dB > c.options.blind_dB);
}

TEST_CASE("records too short for the lines have levels only, and it is told", "[analysis]") {
  const Comparison c = compared(repeats({.count = 3000}, 3, 1), repeats({.count = 3000}, 3, 2));
  CHECK(change_of(c, "mesh") == nullptr);
  REQUIRE(change_of(c, "rms") != nullptr);
  CHECK(is_told(c,
                "record 10: spans 30 turns of the input shaft, and 66 part its lines: 1.5 s are "
                "too short, 3.3 s are needed"));
  REQUIRE(c.too_short.size() == 6);
  CHECK(c.too_short.front().length_s == Approx(1.5).epsilon(1e-3));
  CHECK(c.too_short.front().needed_s == Approx(66 / 20.0));
  CHECK(compared(repeats({}, 3, 1), repeats({}, 3, 2)).too_short.empty());
}

TEST_CASE("a recording that is on both sides is told, whatever it is called", "[analysis]") {
  const std::vector<Recording> a = repeats({}, 3, 1);
  std::vector<Recording> b = repeats({}, 3, 2);
  CHECK(compared(a, b).same_in_both.empty());
  b[1] = a[2];
  b[1].source = "another name";
  const Comparison c = compared(a, b);
  CHECK(c.records_b == 3);
  REQUIRE(c.same_in_both.size() == 1);
  CHECK(c.same_in_both.front().a == 2);
  CHECK(c.same_in_both.front().b == 1);
  CHECK(is_told(c, "another name: the same recording as " + a[2].source + " of A"));
  CHECK(compared(a, a).same_in_both.size() == 3);
}

TEST_CASE("of records that differ in length lines are compared, and no peaks", "[analysis]") {
  const Comparison c = compared(repeats({.scatter_dB = 0.1}, 3, 1),
                                repeats({.scatter_dB = 0.1, .count = 30000}, 3, 2));
  CHECK(change_of(c, "peak") == nullptr);
  CHECK(is_told(c, "accel_1x: peak and crest factor: the records differ in length"));
  CHECK(change_of(c, "mesh")->word == ChangeWord::not_changed);
  // Nor does the noise seem lower where the record is longer.
  CHECK(std::abs(change_of(c, "mesh x2")->change_dB) < 3 * change_of(c, "mesh x2")->uncertainty_dB);
}

TEST_CASE("points in one of both only are listed", "[analysis]") {
  auto a = repeats({.count = 7000}, 2, 1);
  a.push_back(test::gear_record({.count = 7000, .load_pct = 100}, 5));
  const Comparison c = compared(a, repeats({.count = 7000}, 2, 2));
  CHECK(c.points.size() == 1);
  REQUIRE(c.only_a.size() == 1);
  CHECK(c.only_a[0].load_pct == 100);
}

TEST_CASE("channels that are not the same are told, not compared", "[analysis]") {
  const auto a = repeats({.count = 7000}, 2, 1);
  auto b = repeats({.count = 7000}, 2, 2);
  const auto change = [&](auto what) {
    for (Recording& record : b) what(record.channels.front());
  };
  SECTION("another name") {
    change([](Channel& channel) { channel.info.name = "accel_2x"; });
    const Comparison c = compared(a, b);
    CHECK(is_told(c, "1200 rpm, 50 % load, accel_1x: only A has it"));
    CHECK(is_told(c, "1200 rpm, 50 % load, accel_2x: only B has it"));
    CHECK(c.changes.empty());
  }
  SECTION("another unit") {
    change([](Channel& channel) { channel.info.unit = "g"; });
    CHECK(is_told(compared(a, b), "accel_1x: in m/s² in A and g in B"));
  }
  SECTION("no acceleration") {
    auto two = a;
    for (auto* side : {&two, &b}) {
      for (Recording& record : *side) {
        record.channels.push_back(record.channels.front());
        record.channels.back().info = {"proximity", "V", "", not_known};
      }
    }
    const Comparison c = compared(two, b);
    CHECK(c.channels.size() == 1);
    CHECK(is_told(c, "record 20, proximity: is in V, no acceleration"));
    CHECK_FALSE(is_told(c, "accel_1x: is in"));
  }
  SECTION("mounted another way") {
    change([](Channel& channel) { channel.info.direction = "-Z"; });
    CHECK(is_told(compared(a, b), "points to +X in A and -Z in B"));
  }
  SECTION("another rate") {
    change([](Channel& channel) { channel.rate_Hz *= 1.01; });
    CHECK(is_told(compared(a, b), "sampled at 2000 Hz in A and 2020 Hz in B"));
  }
  SECTION("a dead sensor") {
    auto two = a;
    for (auto* side : {&two, &b}) {
      for (Recording& record : *side) {
        record.channels.push_back(record.channels.front());
        record.channels.back().info.name = "accel_1y";
        record.channels.back().samples *= 2;
      }
    }
    change([](Channel& channel) { channel.samples.setZero(); });
    const Comparison c = compared(two, b);
    CHECK(c.channels.size() == 1);
    CHECK(is_told(c, "record 20, accel_1x: "));
    CHECK(is_told(c, "1200 rpm, 50 % load, accel_1x: that of B cannot be trusted"));
  }
  SECTION("two by one name") {
    for (Recording& record : b) record.channels.push_back(record.channels.front());
    const Comparison c = compared(a, b);
    CHECK(c.changes.empty());
    CHECK(is_told(c, "record 20, accel_1x: another channel of the record has the same name"));
  }
}

TEST_CASE("a unit or direction that one does not state is taken as the other's, and told",
          "[analysis]") {
  const auto a = repeats({.count = 7000}, 2, 1);
  auto b = repeats({.count = 7000}, 2, 2);
  CHECK_FALSE(is_told(compared(a, b), "not every file states its"));
  for (Recording& record : b) record.channels.front().info.unit = "";
  CHECK(is_told(compared(a, b), "accel_1x: compared, but not every file states its unit"));
  CHECK_FALSE(is_told(compared(a, b), "states its direction"));
  CHECK_FALSE(is_told(compared(b, b), "not every file states its unit"));  // neither does
  for (Recording& record : b) record.channels.front().info.direction = "";
  CHECK(is_told(compared(a, b), "accel_1x: compared, but not every file states its direction"));
  CHECK_FALSE(compared(a, b).changes.empty());
}

TEST_CASE("copies of a record know no scatter, so that nothing is told of them", "[analysis]") {
  const auto copies = [](const Recording& record) { return std::vector<Recording>(3, record); };
  const Comparison c =
      compared(copies(test::gear_record({}, 1)), copies(test::gear_record({.mesh = 2}, 2)));
  for (const Change& change : c.changes) {
    REQUIRE(change.source == ScatterSource::none);
    REQUIRE(change.word == ChangeWord::cannot_tell);
    REQUIRE(std::isnan(change.p_value));
  }
  CHECK(change_of(c, "mesh")->change_dB == Approx(doubled_dB).margin(0.5));
}

TEST_CASE("a record that its bench gave up is left out", "[analysis]") {
  auto b = repeats({.count = 7000}, 3, 2);
  b[1].status = "not_settled";
  const Comparison c = compared(repeats({.count = 7000}, 3, 1), b);
  CHECK(is_told(c, "record 21: its status is not_settled"));
  CHECK(change_of(c, "mesh")->freedom >= 3);
  CHECK(c.points.at(0).a.records.size() == 3);
  CHECK(c.points.at(0).b.records.size() == 2);
}

TEST_CASE("a record without an angle does not hide that the speeds differ", "[analysis]") {
  auto b = repeats({.count = 7000, .speed_Hz = 20.3}, 2, 2);
  for (Recording& record : b) record.planned_speed_rpm = 1200;
  Recording without = b.front();
  without.speed_rpm = not_known;
  without.channels.pop_back();  // the angle
  b.push_back(without);
  const Comparison c = compared(repeats({.count = 7000}, 2, 1), b);
  CHECK(is_told(c, "neither angle nor speed of the input shaft is known"));
  CHECK(is_told(c, "A turned at 1200.0 rpm and B at 1218.0 rpm"));
}

TEST_CASE("the change that would have been seen is that of one call more", "[analysis]") {
  const CompareOptions options{.least_dB = 0};
  const Comparison c = compared(repeats({.scatter_dB = 0.2}, 3, 1),
                                repeats({.shaft = 5, .scatter_dB = 0.2}, 3, 2), options);
  double asked = 0, called = 0;
  for (const Change& change : c.changes) {
    if (!change.seen || !(change.freedom > 0)) continue;
    ++asked;
    called += change.word == ChangeWord::changed ? 1 : 0;
  }
  REQUIRE(called > 0);
  REQUIRE(called < asked);
  const Change& mesh = *change_of(c, "mesh");
  REQUIRE(mesh.word == ChangeWord::not_changed);
  // From what is stated: half of the 95 % interval is t(0.05) standard errors.
  const double error_dB = mesh.uncertainty_dB / t_of_p_value(0.05, mesh.freedom);
  const double p = options.false_share * (called + 1) / asked;
  CHECK(mesh.detectable_dB ==
        Approx(error_dB * (t_of_p_value(2 * p, mesh.freedom) + t_of_p_value(0.2, mesh.freedom))));
}

namespace {

// A small gear beside a bearing whose line may lie a tenth off order 2.5.
Kinematics gear_with_bearing() {
  Kinematics k = test::small_gear();
  k.orders.push_back({"bearing", 2.5, {}, "bearing_outer", ""});
  k.signatures = {test::spall_of("bearing_outer", 2.5, 1, 0.1)};
  return k;
}

// Three records with a line of the gears at 7/3 and one of the bearing at 2.471.
std::vector<RecordLevels> with_bearing(double gear, double bearing, unsigned seed) {
  const test::OrderSignals signals{.count = 30000};
  std::vector<Recording> records = repeats({.count = 30000}, 3, seed);
  for (Recording& record : records) {
    record.channels.front().samples +=
        gear * signals.tone(7.0 / 3, seed) + bearing * signals.tone(2.471, seed);
  }
  return test::measured(records, gear_with_bearing());
}

}  // namespace

TEST_CASE("a bearing's line is found where it strays to, and gears' lines are none", "[analysis]") {
  const std::vector<Quantity> quantities = quantities_to_compare(gear_with_bearing());
  const auto change = [&](double gear, double bearing) {
    return compare(with_bearing(1, 0.2, 1), with_bearing(gear, bearing, 2), quantities);
  };
  const Comparison worse = change(1, 0.4);
  CHECK(change_of(worse, "bearing")->word == ChangeWord::changed);
  CHECK(change_of(worse, "bearing")->change_dB == Approx(doubled_dB).margin(1));
  REQUIRE(family_headlines(worse).size() == 1);
  CHECK(family_headlines(worse).front().share() == 1);

  const Comparison other = change(2, 0.2);  // the gears' line is five to ten times the bearing's
  CHECK(change_of(other, "bearing")->word == ChangeWord::not_changed);
  CHECK(family_headlines(other).empty());
}

TEST_CASE("options that mean nothing are refused", "[analysis]") {
  CHECK_THROWS_WITH(compare({}, {}, {}, {.least_dB = -1}), Contains("least_dB"));
  CHECK_THROWS_WITH(compare({}, {}, {}, {.false_share = 0}), Contains("false_share"));
  CHECK_THROWS_WITH(compare({}, {}, {}, {.least_dB = 3, .blind_dB = 3}), Contains("blind_dB"));
  CHECK_THROWS_WITH(compare({}, {}, {}, {.seen_p = 0}), Contains("seen_p"));
  CHECK_THROWS_WITH(compare({}, {}, {}, {.found_p = 1}), Contains("found_p"));
  CHECK(compare({}, {}, {}).changes.empty());
}

}  // namespace rvbench::analysis
