#include "analysis/indicators/hysteresis_record.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/diagnosis.hpp"
#include "tests/support/held_reducer.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using test::HeldReducer;

namespace {

using Catch::Matchers::Contains;

analysis::Kinematics rv20e() {
  analysis::Kinematics machine;
  machine.machine = "RV-20E";
  machine.period_turns = machine.gear_ratio = 121;
  machine.rated_output_torque_Nm = 167;
  return machine;
}

const analysis::Indicator* found(const analysis::Examination& seen, std::string_view measure) {
  for (const analysis::Indicator& i : seen.indicators) {
    if (i.measure == measure) return &i;
  }
  return nullptr;
}

// What is said of it, in one text.
std::string told_by(const analysis::Examination& seen) {
  std::string all;
  for (const analysis::QualityNote& note : seen.quality) all += note.what + "\n";
  return all;
}

double value_of(const analysis::Examination& seen, std::string_view measure) {
  const auto* indicator = found(seen, measure);
  return indicator != nullptr ? indicator->value : not_known;
}

}  // namespace

SCENARIO("a reducer that is wound to and fro against a brake tells its lost motion",
         "[analysis][indicators]") {
  GIVEN("1 arc minute of clearance, 48.87 N·m per arc minute, friction of 11 % of rated torque") {
    const analysis::Examination seen = analysis::examine(HeldReducer{}.recorded(), rv20e());
    THEN("it is what the reducer has") {
      CHECK(seen.of_hysteresis);
      // 3 % of 167 N·m to each side: 10.02 N·m more
      CHECK(value_of(seen, "lost_motion") == Approx(1 + 10.02 / 48.87).epsilon(0.01));
      CHECK(value_of(seen, "torsional_stiffness") == Approx(48.87).epsilon(0.005));
      // 0.15 N·m at the input to each side: 2·18.15 N·m at the output
      CHECK(value_of(seen, "hysteresis_width") == Approx(1 + 36.3 / 48.87).epsilon(0.03));
      CHECK(told_by(seen).empty());
    }
    THEN("each has an interval, by its loops") {
      REQUIRE(found(seen, "lost_motion"));
      CHECK(found(seen, "lost_motion")->error > 0);
      CHECK(found(seen, "lost_motion")->error < 0.05);
    }
  }
  GIVEN("none of it") {
    const HeldReducer tight{.clearance_rad = 0, .friction_Nm = 0};
    const analysis::Examination seen = analysis::examine(tight.recorded(), rv20e());
    INFO(told_by(seen));
    THEN("what is left is what yields, and the width of the shaft's drag") {
      CHECK(value_of(seen, "lost_motion") == Approx(10.02 / 48.87).epsilon(0.03));
      // 0.05 N·m·s/rad at 0.1 rad/s, each way
      CHECK(value_of(seen, "hysteresis_width") == Approx(2 * 0.005 * 121 / 48.87).margin(0.005));
    }
  }
}

SCENARIO("an output that gives way is seen, or measured", "[analysis][indicators]") {
  const HeldReducer weak{.brake_Nm = 150};
  GIVEN("a brake that holds less than the drive winds up to") {
    const analysis::Examination seen = analysis::examine(weak.recorded(), rv20e());
    THEN("nothing is told") {
      CHECK(seen.indicators.empty());
      REQUIRE_FALSE(seen.quality.empty());
      CHECK(seen.quality.front().invalidates);
      CHECK_THAT(seen.quality.front().what, Contains("cannot tell") && Contains("the output"));
    }
  }
  GIVEN("the output's angle beside it") {
    HeldReducer seen_through = weak;
    seen_through.has_output_angle = true;
    const analysis::Examination seen = analysis::examine(seen_through.recorded(), rv20e());
    THEN("the lost motion is told, and no stiffness up to a torque that is never reached") {
      CHECK(value_of(seen, "lost_motion") == Approx(1 + 10.02 / 48.87).epsilon(0.02));
      CHECK_FALSE(found(seen, "torsional_stiffness"));
    }
  }
}

TEST_CASE("a record that lacks what hysteresis needs says what it is", "[analysis][indicators]") {
  const HeldReducer reducer{.reversals = 3};
  const auto first_note = [](const Recording& record, const analysis::Kinematics& machine) {
    const analysis::Examination seen = analysis::examine(record, machine);
    REQUIRE(seen.of_hysteresis);
    CHECK(seen.indicators.empty());
    REQUIRE_FALSE(seen.quality.empty());
    CHECK(seen.quality.front().invalidates);
    return seen.quality.front().what;
  };
  Recording record = reducer.recorded();
  analysis::Kinematics machine = rv20e();
  machine.rated_output_torque_Nm = not_known;
  CHECK_THAT(first_note(record, machine), Contains("rated torque is not known"));
  machine.gear_ratio = not_known;
  CHECK_THAT(first_note(record, machine), Contains("gear ratio of RV-20E"));
  record.channels[0].start_s = 0.1;
  CHECK_THAT(first_note(record, rv20e()), Contains("one clock"));
}

TEST_CASE("lost frames of a hysteresis test harm nothing", "[analysis][indicators]") {
  Recording record = HeldReducer{}.recorded();
  for (Eigen::Index i = 7; i < record.channels[0].samples.size(); i += 97) {
    record.channels[0].samples[i] = record.channels[1].samples[i] = not_known;
  }
  const analysis::Examination seen = analysis::examine(record, rv20e());
  CHECK(value_of(seen, "lost_motion") == Approx(1 + 10.02 / 48.87).epsilon(0.01));
}

TEST_CASE("a shaft that turns, or stands, is in no hysteresis test", "[analysis][indicators]") {
  Recording record = HeldReducer{.reversals = 1}.recorded();
  Eigen::VectorXd& angle_rad = record.channels[1].samples;
  const Eigen::Index n = angle_rad.size();
  angle_rad = 30 * test::times_s(n, 500).matrix() + 0.01 * test::white_noise(n, 1);
  CHECK_FALSE(analysis::is_hysteresis_test(record));
  angle_rad = (test::white_noise(n, 1).array() > 0).cast<double>() * 1e-4;  // one count, to and fro
  CHECK_FALSE(analysis::is_hysteresis_test(record));
  angle_rad.setZero();
  CHECK_FALSE(analysis::is_hysteresis_test(record));
  record.channels.pop_back();
  CHECK_FALSE(analysis::is_hysteresis_test(record));
}
