#include <catch2/catch.hpp>

#include "analysis/diagnosis.hpp"
#include "analysis/rv_reducer.hpp"
#include "tests/analysis/order_signals.hpp"

using namespace rvbench;
using analysis::conclude;
using analysis::Diagnosis;
using analysis::Examination;
using analysis::examine;
using analysis::Kinematics;
using Catch::Matchers::Contains;
using test::OrderSignals;

namespace {

const OrderSignals turning{.speed_Hz = 20, .rate_Hz = 1280, .count = 6800};  // 5 periods

Kinematics small_reducer() { return analysis::rv_reducer("small", {12, 24, 2, 9, 10}, {}); }

Eigen::VectorXd faulty() {
  return turning.modulated(240.0 / 21, 20.0 / 21, 0.5) + 0.1 * turning.noise(1);
}

std::string complaints(const Examination& e) {
  std::string all;
  for (const auto& note : e.quality) {
    CHECK(note.invalidates);
    all += note.where + ": " + note.what + "\n";
  }
  return all;
}

// The record of a faulty unit whose second channel is bad.
Examination beside(const Eigen::VectorXd& bad) {
  Recording record = turning.recording(faulty());
  record.channels.push_back(turning.channel(bad, "accel_2z"));
  return examine(record, small_reducer());
}

}  // namespace

TEST_CASE("a bad channel is named, and the good one still examined", "[analysis][quality]") {
  Eigen::VectorXd bad = faulty();
  std::string what;
  SECTION("with a gap") {
    bad.segment(1000, 30).setConstant(not_known);
    what = "lost samples: 30";
  }
  SECTION("clipped") {
    bad = bad.cwiseMin(0.8).cwiseMax(-0.8);
    what = "clipped";
  }
  SECTION("dead") {
    bad.setConstant(0.01);
    what = "dead";
  }
  SECTION("cut short") {
    bad = bad.head(100).eval();
    what = "too short: 100 samples";
  }
  const Examination e = beside(bad);
  CHECK_THAT(complaints(e), Contains("synthetic, accel_2z") && Contains(what));
  CHECK(e.quality.size() == 1);
  CHECK(e.resolvable);
  REQUIRE(e.channels.size() == 2);
  CHECK(e.channels[0].rms > 0);
  CHECK_FALSE(e.channels[0].imf_correlation.empty());
  CHECK(e.channels[1].imf_correlation.empty());
  CHECK(e.scores.front().p_value < 1e-6);
}

TEST_CASE("the full scale that the caller knows is where clipping is looked for",
          "[analysis][quality]") {
  Eigen::VectorXd x = faulty();
  x *= 40 / x.maxCoeff();
  CHECK(complaints(examine(turning.recording(x), small_reducer(), {.clip_level = 50})) == "");
  CHECK_THAT(complaints(examine(turning.recording(x), small_reducer(), {.clip_level = 40})),
             Contains("clipped: 2 "));
}

TEST_CASE("a record that is clipped is too short only if it is short", "[analysis][quality]") {
  Recording record = turning.recording(faulty().cwiseMin(0.8).cwiseMax(-0.8));
  const Examination whole = examine(record, small_reducer());
  CHECK_FALSE(whole.resolvable);
  CHECK_THAT(complaints(whole), Contains("clipped") && !Contains("too short"));
  record.channels[0].samples.conservativeResize(turning.count / 2);
  const Examination half = examine(record, small_reducer());
  CHECK_THAT(complaints(half),
             Contains("clipped") && Contains("too short: 2 whole periods of the gear train, 4 are "
                                             "needed to part its orders: 4.2 s at this speed"));
  CHECK_THAT(half.quality.front().what, Contains("clipped"));  // to be mended first
}

TEST_CASE("a record of nothing but bad channels is not resolvable", "[analysis][quality]") {
  const Examination e =
      examine(turning.recording(Eigen::VectorXd::Zero(turning.count)), small_reducer());
  CHECK_FALSE(e.resolvable);
  CHECK_THAT(complaints(e), Contains("dead"));
  for (const auto& score : e.scores) CHECK(score.p_value == 1);
  CHECK(conclude({e}, small_reducer()).findings.empty());
  CHECK_FALSE(conclude({e}, small_reducer()).resolvable);
}

TEST_CASE("where the speed is stated it is told which meshes no ratio is read of",
          "[analysis][quality]") {
  Recording record = turning.recording(faulty());
  CHECK(examine(record, small_reducer()).quality.empty());
  record.channels.pop_back();  // the angle
  const Examination e = examine(record, small_reducer());
  REQUIRE(e.quality.size() == 1);
  CHECK_FALSE(e.quality[0].invalidates);
  CHECK_THAT(e.quality[0].what, Contains("no sideband ratio, FM0, FM4 and NA4 of sun-planet mesh"));
}

TEST_CASE("four periods of the gear train can be judged, three cannot", "[analysis][quality]") {
  const auto of_periods = [](double periods) {
    Recording record = turning.recording(faulty());
    const auto n = static_cast<Eigen::Index>(std::ceil(periods * 21 / 20 * turning.rate_Hz)) + 1;
    record.channels[0].samples.conservativeResize(n);
    return examine(record, small_reducer());
  };
  CHECK(of_periods(4).periods == 4);
  CHECK(of_periods(4).resolvable);
  CHECK(complaints(of_periods(4)) == "");
  const Examination three = of_periods(3.9);
  CHECK(three.periods == 3);
  CHECK_FALSE(three.resolvable);
  CHECK_THAT(complaints(three), Contains("too short: 3 whole periods"));
  const Diagnosis d = conclude({three}, small_reducer());
  CHECK_FALSE(d.resolvable);
  CHECK(d.findings.empty());
  CHECK(d.below_limit.empty());
  CHECK(d.quality.size() == 1);
}

TEST_CASE("a record without a shaft speed cannot be judged, and says so", "[analysis][quality]") {
  Recording record = turning.recording(faulty());
  SECTION("not stated") {
    record.speed_rpm = not_known;
    record.channels.pop_back();
  }
  SECTION("standing still") { record.channels[1].samples.setConstant(1); }
  SECTION("turning back") {
    record.channels[1].samples.tail(100) = record.channels[1].samples.tail(100).reverse().eval();
  }
  const Examination e = examine(record, small_reducer());
  CHECK_FALSE(e.resolvable);
  CHECK_THAT(complaints(e), Contains("speed"));
}

TEST_CASE("a record without accelerations cannot be judged", "[analysis][quality]") {
  Recording record = turning.recording(faulty());
  record.channels.erase(record.channels.begin());
  CHECK_THAT(complaints(examine(record, small_reducer())), Contains("no acceleration channel"));
  CHECK_FALSE(examine(record, small_reducer()).resolvable);
  CHECK_FALSE(examine(Recording{}, small_reducer()).resolvable);
}
