#include "analysis/quality.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::acceleration_channels;
using analysis::accelerometer_quality;
using analysis::channel_quality;
using analysis::Diagnosis;
using analysis::Examination;
using analysis::Finding;
using analysis::Kinematics;
using analysis::shows_shaft;
using Catch::Matchers::Contains;

namespace {

constexpr double rate_Hz = 4960;

Channel channel(Eigen::VectorXd samples) {
  return {{"accel_1x", "m/s²", "+X", not_known}, rate_Hz, 0, std::move(samples)};
}

// A vibration with noise, at most about 5 m/s².
Eigen::VectorXd vibration() {
  return 3 * test::tone(87.3, 9920, rate_Hz) + 0.5 * test::white_noise(9920, 1);
}

std::string complaint(const Channel& c, double clip_level = not_known) {
  const auto notes = channel_quality(c, clip_level);
  if (notes.empty()) return "";
  CHECK(notes.front().where == "accel_1x");
  CHECK(notes.front().invalidates);
  return notes.front().what;
}

}  // namespace

TEST_CASE("a sound channel gets no note", "[analysis][quality]") {
  CHECK(complaint(channel(vibration())) == "");
  CHECK(complaint(channel(1e-6 * vibration())) == "");
  CHECK(complaint(channel(vibration().array() + 100)) == "");
  CHECK(complaint(channel(vibration()), 50) == "");
}

TEST_CASE("a gap in the samples is counted", "[analysis][quality]") {
  Eigen::VectorXd x = vibration();
  x.segment(4000, 17).setConstant(not_known);
  CHECK_THAT(complaint(channel(x)), Contains("lost samples: 17 of 9920"));
  x[9000] = std::numeric_limits<double>::infinity();
  CHECK_THAT(complaint(channel(x)), Contains("18 of 9920"));
}

TEST_CASE("a channel of nothing but lost samples is not mistaken for a dead one",
          "[analysis][quality]") {
  CHECK_THAT(complaint(channel(Eigen::VectorXd::Constant(1000, not_known))),
             Contains("lost samples: 1000"));
}

TEST_CASE("a channel that never moves is dead, whatever its offset", "[analysis][quality]") {
  const auto stuck_at = GENERATE(0.0, 2.5, -1e-9);
  CHECK_THAT(complaint(channel(Eigen::VectorXd::Constant(1000, stuck_at))), Contains("dead"));
}

TEST_CASE("an accelerometer that dies in the middle of a record is found, a torque may stand still",
          "[analysis][quality]") {
  Eigen::VectorXd x = vibration();
  x.segment(3000, 2400).setConstant(1.5);  // just less than half a second
  CHECK(accelerometer_quality(channel(x), not_known).empty());
  x.segment(3000, 2500).setConstant(1.5);
  const auto notes = accelerometer_quality(channel(x), not_known);
  REQUIRE(notes.size() == 1);
  CHECK(notes.front().where == "accel_1x");
  CHECK(notes.front().invalidates);
  CHECK_THAT(notes.front().what, Contains("2500 samples in a row are the same"));
  CHECK(complaint(channel(x)) == "");
  CHECK(accelerometer_quality(channel(vibration()), not_known).empty());
}

TEST_CASE("clipping is seen at the extremes where full scale is not known", "[analysis][quality]") {
  SECTION("at both ends") {
    CHECK_THAT(complaint(channel(vibration().cwiseMin(2.9).cwiseMax(-2.9))), Contains("clipped"));
  }
  SECTION("at one end, nearer to zero than the other's peaks") {
    const Eigen::Index above = (vibration().array() >= 2.5).count();
    REQUIRE(above > 1000);
    const auto notes = channel_quality(channel(vibration().cwiseMin(2.5)), not_known);
    REQUIRE(notes.size() == 1);
    CHECK_THAT(notes[0].what, Contains("clipped"));
    CHECK_THAT(complaint(channel(vibration().cwiseMax(-2.5))), Contains("clipped"));
    CHECK_THAT(complaint(channel(vibration().array().min(2.5) - 10)), Contains("clipped"));
    CHECK_THAT(complaint(channel(vibration().array().max(-2.5) + 10)), Contains("clipped"));
  }
}

TEST_CASE("clipping is counted at the full scale that the caller states", "[analysis][quality]") {
  Eigen::VectorXd x = vibration().cwiseMin(4.9).cwiseMax(-4.9);
  x[100] = 5;
  x[2000] = -5;
  CHECK_THAT(complaint(channel(x), 5), Contains("clipped: 2 samples"));
  CHECK(complaint(channel(x), 10) == "");
}

TEST_CASE("too few samples are said to be too few", "[analysis][quality]") {
  CHECK_THAT(complaint(channel(vibration().head(100))), Contains("too short: 100 samples"));
  CHECK_THAT(complaint(channel(Eigen::VectorXd{})), Contains("too short: 0 samples"));
}

TEST_CASE("samples without a rate cannot be judged", "[analysis][quality]") {
  Channel c = channel(vibration());
  c.rate_Hz = GENERATE(0.0, -4960.0, not_known);
  CHECK_THAT(complaint(c), Contains("rate"));
}

TEST_CASE("a diagnosis looks at accelerations, and at what has no unit", "[analysis][quality]") {
  Recording record;
  for (const char* unit : {"m/s²", "N·m", "g", "rad", "", "V"}) {
    Channel c = channel(vibration().head(300));
    c.info.unit = unit;
    record.channels.push_back(c);
  }
  const auto channels = acceleration_channels(record);
  REQUIRE(channels.size() == 3);
  CHECK(channels[0] == &record.channels[0]);
  CHECK(channels[1] == &record.channels[2]);
  CHECK(channels[2] == &record.channels[4]);
  CHECK(acceleration_channels({}).empty());
}

namespace {

// A shaft with a bearing on it.
Kinematics shaft_and_bearing() {
  Kinematics kinematics;
  kinematics.orders = {{"shaft", 1, "", "motor", ""}, {"inner race", 5.415, "", "bearing", ""}};
  kinematics.signatures.resize(2);
  kinematics.signatures[0].component = "motor";
  kinematics.signatures[1].component = "bearing";
  kinematics.signatures[1].order = 5.415;
  kinematics.signatures[1].slip = 0.02;
  return kinematics;
}

Examination point_with_line(const std::string& meaning, double order = 1) {
  Examination point;
  point.channels.resize(2);
  point.channels[1].lines = {{order, 30 * order, 0.01, 1e-9, meaning}};
  return point;
}

Diagnosis within_limits(const std::string& component) {
  Diagnosis diagnosis;
  diagnosis.below_limit.resize(1);
  diagnosis.below_limit[0].component = component;
  return diagnosis;
}

}  // namespace

TEST_CASE("a line on a characteristic order shows that the data are of the machine",
          "[analysis][quality]") {
  const Kinematics kinematics = shaft_and_bearing();
  CHECK(shows_shaft({Examination(), point_with_line("shaft")}, {}, kinematics));
  // A twelfth harmonic is met by chance.
  CHECK_FALSE(shows_shaft({point_with_line("shaft x12")}, {}, kinematics));
  CHECK_FALSE(shows_shaft({point_with_line("")}, {}, kinematics));
  CHECK_FALSE(shows_shaft({}, {}, kinematics));
}

TEST_CASE("of signatures within limits, only those locked to the shaft show the machine",
          "[analysis][quality]") {
  const Kinematics kinematics = shaft_and_bearing();
  CHECK(shows_shaft({Examination()}, within_limits("motor"), kinematics));
  CHECK_FALSE(shows_shaft({Examination()}, within_limits("bearing"), kinematics));
  Diagnosis bad;
  bad.findings.resize(1);
  bad.findings[0].component = "bearing";  // at a wrong speed one fault is the other's
  CHECK_FALSE(shows_shaft({Examination()}, bad, kinematics));
  bad.findings[0].component = "motor";
  CHECK(shows_shaft({Examination()}, bad, kinematics));
}

TEST_CASE("what slips is no witness of the speed, nor is a line in one channel of many",
          "[analysis][quality]") {
  const Kinematics kinematics = shaft_and_bearing();
  CHECK_FALSE(shows_shaft({point_with_line("inner race", 5.4)}, {}, kinematics));
  Examination point = point_with_line("shaft");
  point.channels.resize(3);
  CHECK_FALSE(shows_shaft({point}, {}, kinematics));
  point.channels[0].lines = point.channels[1].lines;
  CHECK(shows_shaft({point}, {}, kinematics));
}
