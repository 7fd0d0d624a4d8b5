#include "analysis/shaft_angle.hpp"

#include "analysis/spectrum.hpp"
#include "tests/support/signals.hpp"
#include "tests/support/spectrum_matchers.hpp"

using namespace rvbench;
using analysis::amplitude_spectrum;
using analysis::ShaftAngle;
using analysis::Window;
using test::PeaksAt;

namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double rate_Hz = 2000;
constexpr Eigen::Index count = 20000;  // 10 s

// Turns after t of a shaft that runs up from 10 rev/s by 0.5 rev/s².
Eigen::ArrayXd run_up(const Eigen::ArrayXd& t) { return 10 * t + 0.25 * t.square(); }

Channel accel(const Eigen::VectorXd& samples, double start_s = 0) {
  return {{"accel_1x", "m/s²", "", not_known}, rate_Hz, start_s, samples};
}

Channel angle(const Eigen::ArrayXd& turns, double angle_rate_Hz, double start_s = 0) {
  return {{"input_angle", "rad", "", not_known}, angle_rate_Hz, start_s, turns * two_pi};
}

Recording stated(double speed_rpm, Eigen::Index n = count) {
  Recording record;
  record.speed_rpm = speed_rpm;
  record.channels = {accel(Eigen::VectorXd::Zero(n))};
  return record;
}

Recording measured(Channel input_angle) {
  Recording record = stated(not_known);
  record.channels.push_back(std::move(input_angle));
  return record;
}

}  // namespace

TEST_CASE("a stated speed is taken as constant", "[analysis][angle]") {
  const auto shaft = ShaftAngle::of(stated(605));
  REQUIRE(shaft);
  CHECK_FALSE(shaft->is_measured());
  CHECK(shaft->mean_speed_Hz() == Approx(605.0 / 60));
  CHECK(shaft->turns_at(6) == Approx(60.5));
  CHECK(ShaftAngle::of(stated(-605))->turns_at(6) == Approx(60.5));
}

TEST_CASE("a measured angle outweighs the speed that was stated", "[analysis][angle]") {
  Recording record = measured(angle(9.9 * test::times_s(1000, 100), 100));
  record.speed_rpm = 600;
  record.planned_speed_rpm = 600;
  const auto shaft = ShaftAngle::of(record);
  REQUIRE(shaft);
  CHECK(shaft->is_measured());
  CHECK(shaft->mean_speed_Hz() == Approx(9.9));
}

TEST_CASE("between samples of the angle a run-up is followed to the curve", "[analysis][angle]") {
  const auto shaft = ShaftAngle::of(measured(angle(run_up(test::times_s(1001, 100)), 100)));
  REQUIRE(shaft);
  // Between samples a straight line is off by at most a·h²/8 = 0.5·0.01²/8 turns.
  for (const double t : {0.0, 0.003, 1.234, 5.0, 9.99}) {
    CAPTURE(t);
    CHECK(shaft->turns_at(t) == Approx(10 * t + 0.25 * t * t).margin(0.5e-4 / 8 + 1e-12));
  }
  CHECK(shaft->mean_speed_Hz() == Approx(12.5));
}

TEST_CASE("a shaft that turns the other way counts its turns, too", "[analysis][angle]") {
  const auto shaft = ShaftAngle::of(measured(angle(-run_up(test::times_s(1001, 100)), 100)));
  REQUIRE(shaft);
  CHECK(shaft->turns_at(4) == Approx(44));
}

TEST_CASE("lost angle samples are bridged", "[analysis][angle]") {
  Channel input_angle = angle(10 * test::times_s(1000, 100), 100);
  const auto gap = GENERATE(0, 400, 990);
  input_angle.samples.segment(gap, 10).setConstant(not_known);
  const auto shaft = ShaftAngle::of(measured(input_angle));
  REQUIRE(shaft);
  if (gap == 400) CHECK(shaft->turns_at(4.05) - shaft->turns_at(3.5) == Approx(5.5));
  CHECK(shaft->turns_at(8) - shaft->turns_at(5) == Approx(30));
}

TEST_CASE("a shaft that stands, turns back or is not known has no angle", "[analysis][angle]") {
  CHECK_FALSE(ShaftAngle::of(stated(not_known)));
  CHECK_FALSE(ShaftAngle::of(stated(0)));
  CHECK_FALSE(ShaftAngle::of(Recording{}));
  const Eigen::ArrayXd t = test::times_s(1000, 100);
  CHECK_FALSE(ShaftAngle::of(measured(angle(Eigen::ArrayXd::Constant(1000, 3), 100))));
  CHECK_FALSE(ShaftAngle::of(measured(angle(10 * t * (9 - t), 100))));
  CHECK_FALSE(ShaftAngle::of(measured(angle(Eigen::ArrayXd::Constant(1000, not_known), 100))));
  CHECK_FALSE(ShaftAngle::of(measured(angle(10 * t, 0))));  // at no rate that is known
}

SCENARIO("over the shaft angle, an order of a run-up is one line", "[analysis][angle]") {
  GIVEN("1.5 m/s² at order 7.25 while the shaft runs up from 10 to 15 rev/s") {
    const Eigen::VectorXd x = 1.5 * (two_pi * 7.25 * run_up(test::times_s(count, rate_Hz))).cos();
    const auto shaft = ShaftAngle::of(measured(angle(run_up(test::times_s(1001, 100)), 100)));
    REQUIRE(shaft);

    WHEN("it is sampled over periods of 4 turns") {
      const Eigen::VectorXd even = shaft->resample(x, rate_Hz, 0, 4, 256);
      const double turns = 31 * 4;  // of 125
      const auto spectrum = amplitude_spectrum(even, double(even.size()) / turns, Window::hann);
      THEN("whole periods are kept, and the line reads order and amplitude") {
        CHECK(even.size() == 32000);  // no prime above 5 in it, and 31744 at least
        CHECK_THAT(spectrum, PeaksAt(7.25));
        CHECK(spectrum.amplitude.maxCoeff() == Approx(1.5).epsilon(2e-3));
      }
    }
    WHEN("the mean speed is all that is used") {
      Recording record = stated(12.5 * 60);
      const Eigen::VectorXd even = ShaftAngle::of(record)->resample(x, rate_Hz, 0, 4, 256);
      THEN("the line is smeared: the angle is what makes it sharp") {
        CHECK(amplitude_spectrum(even, 256, Window::hann).amplitude.maxCoeff() < 0.75);
      }
    }
  }
}

TEST_CASE("channels on clocks of their own meet at the same instant", "[analysis][angle]") {
  // Angle from 100.0 s on, acceleration from 100.5 s on: its first sample is 5 turns in.
  const auto shaft = ShaftAngle::of(measured(angle(10 * test::times_s(1101, 100), 100, 100)));
  REQUIRE(shaft);
  const Eigen::VectorXd x = (two_pi * 3 * 10 * test::times_s(count, rate_Hz)).sin();
  const Eigen::VectorXd even = shaft->resample(x, rate_Hz, 100.5, 1, 64);
  CHECK(even.size() == 100 * 64);
  const Eigen::VectorXd ideal = (two_pi * 3 * test::times_s(even.size(), 64)).sin();
  CHECK((even - ideal).head(99 * 64).cwiseAbs().maxCoeff() < 1e-3);
}

TEST_CASE("a record spans so many whole periods as the shaft turned in it", "[analysis][angle]") {
  // 10 s from 2 s on, at 10 rev/s and 0.5 rev/s² more: 10·10 + 0.25·(12² − 2²) = 135 turns.
  const auto shaft = ShaftAngle::of(measured(angle(run_up(test::times_s(1300, 100)), 100)));
  REQUIRE(shaft);
  CHECK(shaft->whole_periods(count, rate_Hz, 2, 45) == 3);
  CHECK(shaft->whole_periods(count, rate_Hz, 2, 46) == 2);
  CHECK(shaft->whole_periods(count, rate_Hz, 2, 136) == 0);
}

TEST_CASE("a record shorter than one period gives nothing", "[analysis][angle]") {
  const auto shaft = ShaftAngle::of(stated(600));
  REQUIRE(shaft);
  CHECK(shaft->resample(Eigen::VectorXd::Zero(count), rate_Hz, 0, 121, 32).size() == 0);
  CHECK(shaft->resample(Eigen::VectorXd::Zero(count), rate_Hz, 0, 100, 32).size() == 3200);
}

TEST_CASE("a tone keeps its amplitude up to 0.4 of the rate, and makes no images",
          "[analysis][angle][law]") {
  // 20 turns/s, 128 samples a turn: 2560 Hz from 2000 Hz, where a poor interpolator's image of a
  // tone f at 2000 − f folds down to 560 Hz + f.
  const auto shaft = ShaftAngle::of(stated(1200));
  REQUIRE(shaft);
  const double order = GENERATE(1.0, 10.0, 20.0, 30.0, 40.0);
  CAPTURE(order);
  const Eigen::VectorXd even =
      shaft->resample(test::tone(order * 20, count, rate_Hz), rate_Hz, 0, 1, 128);
  const Eigen::VectorXd inner = even.segment(128, 198 * 128);  // away from the ends
  Eigen::VectorXd amplitude = amplitude_spectrum(inner, 128, Window::hann).amplitude;
  const auto line = static_cast<Eigen::Index>(std::lround(order * 198));
  CHECK(amplitude[line] == Approx(1).epsilon(1e-3));
  amplitude.segment(line - 2, 5).setZero();
  CHECK(amplitude.maxCoeff() < 1e-3);
}

TEST_CASE("a constant stays what it is", "[analysis][angle]") {
  const auto shaft = ShaftAngle::of(stated(605));
  REQUIRE(shaft);
  const Eigen::VectorXd even =
      shaft->resample(Eigen::VectorXd::Constant(count, -3), rate_Hz, 0, 1, 100);
  CHECK((even.array() + 3).abs().maxCoeff() < 1e-12);
}
