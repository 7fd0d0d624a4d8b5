#include "analysis/envelope/kurtogram.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/analysis/envelope/strikes.hpp"
#include "tests/analysis/null_rates.hpp"
#include "tests/analysis/order_signals.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using test::NoOftenerThanStated;
using test::NullDraws;
using test::reddened;
using test::resonant;
using test::Strikes;
using test::white_noise;

namespace {

constexpr double rate_Hz = 10000;

// The least p-value of all bands, for having looked at all of them.
double p_of_all(const Kurtogram& kurtogram) {
  double least = 1, bands = 0;
  for (const KurtogramLevel& level : kurtogram.levels) {
    least = std::min(least, level.p_value.minCoeff());
    bands += double(level.p_value.size());
  }
  return std::min(1.0, bands * least);
}

template <class Noise>
NullDraws draws_of(unsigned draws, Noise noise) {
  NullDraws result;
  for (unsigned seed = 1; seed <= draws; ++seed) {
    result.p_values.push_back(p_of_all(fast_kurtogram(noise(seed), rate_Hz, {.levels = 5})));
  }
  return result;
}

}  // namespace

TEST_CASE("the bands of a kurtogram are halves and thirds of one another", "[analysis][envelope]") {
  const Kurtogram kurtogram = fast_kurtogram(white_noise(20000, 1), rate_Hz, {.levels = 4});
  const Eigen::Index bands[] = {1, 2, 3, 4, 6, 8, 12, 16};
  REQUIRE(kurtogram.levels.size() == std::size(bands));
  for (std::size_t i = 0; i < std::size(bands); ++i) {
    CHECK(kurtogram.levels[i].kurtosis.size() == bands[i]);
    CHECK(kurtogram.levels[i].p_value.size() == bands[i]);
    CHECK(kurtogram.levels[i].width_Hz == Approx(5000.0 / double(bands[i])));
    CHECK(kurtogram.levels[i].level == Approx(std::log2(bands[i])));
  }
}

TEST_CASE("a short record has fewer levels", "[analysis][envelope]") {
  CHECK(fast_kurtogram(white_noise(256, 1), rate_Hz).levels.size() == 2);
  CHECK(fast_kurtogram(white_noise(2048, 1), rate_Hz).levels.back().kurtosis.size() == 16);
}

SCENARIO("strikes are found in the band that rings with them", "[analysis][envelope]") {
  GIVEN("a resonance at 3.1 kHz, struck 45 times a second, in noise of twice its rms") {
    const Strikes strikes{rate_Hz, 45, 3100, 800, 0.01};
    const Eigen::VectorXd ringing = strikes.samples(40000);
    const Eigen::VectorXd x = ringing + 2 * test::rms(ringing) * white_noise(40000, 1);
    WHEN("the kurtogram is taken") {
      const Kurtogram kurtogram = fast_kurtogram(x, rate_Hz);
      THEN("the best band holds the resonance, about as wide as it rings") {
        REQUIRE(kurtogram.best);
        CHECK(kurtogram.best->from_Hz < 3100);
        CHECK(kurtogram.best->to_Hz > 3100);
        CHECK(std::abs(kurtogram.best->centre_Hz() - 3100) < 300);
        CHECK(kurtogram.best->width_Hz() < 1300);
        CHECK(kurtogram.best->kurtosis > 1);
        CHECK(kurtogram.best->p_value < 1e-6);
      }
    }
    WHEN("a band must be at least 1 kHz wide") {
      const Kurtogram kurtogram = fast_kurtogram(x, rate_Hz, {.least_width_Hz = 1000});
      THEN("it is") {
        REQUIRE(kurtogram.best);
        CHECK(kurtogram.best->width_Hz() >= 1000);
        CHECK(kurtogram.best->from_Hz < 3100);
        CHECK(kurtogram.best->to_Hz > 3100);
      }
    }
  }
  GIVEN("the same without noise") {
    const Eigen::VectorXd x = Strikes{rate_Hz, 45, 3100, 800, 0.01}.samples(40000);
    THEN("a strike that rings for 1.25 ms out of 22 has the kurtosis of its energy") {
      // <e^(-4dt)>/<e^(-2dt)>² - 2 = d/f - 2, where f strikes come per second: 15.8 if no ringing
      // reaches the next strike. The band of all holds all of it.
      const Kurtogram kurtogram = fast_kurtogram(x, rate_Hz);
      CHECK(kurtogram.levels[0].kurtosis[0] == Approx(800.0 / 45 - 2).epsilon(0.1));
    }
  }
}

TEST_CASE("noise has no best band oftener than stated", "[analysis][envelope][null]") {
  SECTION("if it is white") {
    const NullDraws draws = draws_of(150, [](unsigned seed) { return white_noise(8192, seed); });
    CHECK_THAT(draws, NoOftenerThanStated({0.01, 0.1, 0.5}));
    CHECK(draws.share_below(0.5) > 0.15);  // nor is it never
  }
  SECTION("if it falls with frequency") {
    CHECK_THAT(draws_of(100, [](unsigned seed) { return reddened(white_noise(8192, seed), 0.95); }),
               NoOftenerThanStated({0.01, 0.1, 0.5}));
  }
  SECTION("if it rings at 1 % of damping") {
    CHECK_THAT(
        draws_of(100, [](unsigned seed) { return resonant(white_noise(8192, seed), 0.2, 0.01); }),
        NoOftenerThanStated({0.01, 0.1, 0.5}));
  }
}

TEST_CASE("tones are no strikes, even 60 dB above the noise and cut off by the record",
          "[analysis][envelope][null]") {
  const Eigen::VectorXd x = 1e3 * test::tone(123.4, 20000, rate_Hz) +
                            300 * test::tone(871.9, 20000, rate_Hz, 1) + white_noise(20000, 5);
  CHECK_FALSE(fast_kurtogram(x, rate_Hz).best);
}

TEST_CASE("scale, offset and unit of a record do not matter", "[analysis][envelope][law]") {
  const Eigen::VectorXd x =
      Strikes{rate_Hz, 45, 3100, 800, 0.01}.samples(8192) + 0.1 * white_noise(8192, 1);
  const Kurtogram one = fast_kurtogram(x, rate_Hz);
  const Kurtogram other = fast_kurtogram(1e-6 * x.array() + 3, rate_Hz);
  REQUIRE((one.best && other.best));
  CHECK(other.best->kurtosis == Approx(one.best->kurtosis).epsilon(1e-6));
  CHECK(other.best->from_Hz == one.best->from_Hz);
}

TEST_CASE("nothing to take a kurtogram of throws", "[analysis][envelope]") {
  CHECK_THROWS_AS(fast_kurtogram(white_noise(255, 1), rate_Hz), std::invalid_argument);
  CHECK_THROWS_AS(fast_kurtogram(white_noise(512, 1), 0), std::invalid_argument);
  CHECK_THROWS_AS(fast_kurtogram(white_noise(512, 1), rate_Hz, {.levels = 0}),
                  std::invalid_argument);
  CHECK_THROWS_AS(fast_kurtogram(white_noise(512, 1), rate_Hz, {.false_alarm_rate = 0}),
                  std::invalid_argument);
  Eigen::VectorXd gap = white_noise(512, 1);
  gap[3] = std::nan("");
  CHECK_THROWS_AS(fast_kurtogram(gap, rate_Hz), std::invalid_argument);
  CHECK_FALSE(fast_kurtogram(Eigen::VectorXd::Constant(512, 7), rate_Hz).best);
}
