#include "hal/can/frame_clock.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

using rvbench::hal::FrameClock;

namespace {

constexpr double rate_Hz = 496;

struct Stream {
  std::vector<double> came_s, told_s;
  double uncertainty_s = 0;
};

// A stream at rate_Hz whose sample i, taken at i / true_rate_Hz, comes so much later.
Stream stream(int samples, const std::function<double(int)>& late_s,
              double true_rate_Hz = rate_Hz) {
  FrameClock clock(rate_Hz);
  Stream stream;
  for (int i = 0; i < samples; ++i) {
    const double came_s = i / true_rate_Hz + late_s(i);
    if (i == 0) clock.start(came_s);
    stream.told_s.push_back(i == 0 ? came_s : clock.next(came_s, 1));
    stream.came_s.push_back(came_s);
  }
  stream.uncertainty_s = clock.uncertainty_s();
  return stream;
}

// By how much a speed over 5 samples, as an interlock looks at it, is wrong at most.
double worst_speed(const std::vector<double>& times_s, int from = 0) {
  double worst = 0;
  for (auto i = static_cast<std::size_t>(from) + 5; i < times_s.size(); ++i) {
    worst = std::max(worst, std::abs(5 / rate_Hz / (times_s[i] - times_s[i - 5]) - 1));
  }
  return worst;
}

}  // namespace

TEST_CASE("samples that come when expected keep their times", "[hal]") {
  const Stream even = stream(5000, [](int) { return 0.25; });
  CHECK(even.told_s == even.came_s);
  CHECK(even.uncertainty_s == 0);
}

SCENARIO("samples that come late, each by another while, were taken evenly", "[hal]") {
  GIVEN("an adapter and a busy computer that hold them up by 0 to 7 ms") {
    const auto late_s = [](int i) { return 0.001 * (i / 3 * 5 % 8); };
    const Stream uneven = stream(10'000, late_s);
    THEN("times of arrival tell speeds that no shaft has, and the clock's do not") {
      CHECK(worst_speed(uneven.came_s) > 0.5);
      CHECK(worst_speed(uneven.told_s) < 0.055);
      CHECK(worst_speed(uneven.told_s, 1000) < 0.02);
    }
    THEN("the clock says how far its times are off the arrivals: within them, and not at no time") {
      double off_s = 0;
      for (std::size_t i = 9000; i < 10'000; ++i) {
        off_s += std::abs(uneven.came_s[i] - uneven.told_s[i]) / 1000;
      }
      CHECK(uneven.uncertainty_s == Approx(off_s).epsilon(0.1));
      CHECK(uneven.uncertainty_s > 0.0005);
    }
  }
  GIVEN("a computer that is away for 0.3 s, then finds all that waited") {
    const auto late_s = [](int i) { return i >= 1000 && i < 1150 ? (1150 - i) / rate_Hz : 0.0; };
    const Stream held_up = stream(3000, late_s);
    THEN("no speed is told wrong by more than what an interlock leaves room for") {
      CHECK(worst_speed(held_up.told_s) < 0.31);
    }
    THEN("after it the times are right again") {
      CHECK(held_up.told_s.back() == Approx(held_up.came_s.back()).margin(1e-6));
    }
  }
  GIVEN("a first sample that came late") {
    const Stream first = stream(1000, [](int i) { return i == 0 ? 0.02 : 0.0; });
    THEN("the others are not pulled after it") {
      CHECK(first.told_s.back() == Approx(first.came_s.back()).margin(1e-9));
      CHECK(worst_speed(first.told_s) < 0.055);
    }
  }
}

TEST_CASE("a stream whose rate is not the one stated is followed", "[hal]") {
  for (const double off : {-0.008, 0.008}) {
    CAPTURE(off);
    const Stream other = stream(
        60'000, [](int) { return 0.0; }, rate_Hz * (1 + off));
    CHECK(other.told_s.back() == Approx(other.came_s.back()).margin(0.0085));
  }
}

TEST_CASE("a frame clock without a rate is the caller's bug", "[hal]") {
  CHECK_THROWS_AS(FrameClock(0), std::invalid_argument);
}
