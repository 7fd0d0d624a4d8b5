#include "analysis/envelope_spectra.hpp"

#include <catch2/catch.hpp>

#include "tests/analysis/eight_periods.hpp"
#include "tests/support/spectrum_matchers.hpp"

using namespace rvbench;
using analysis::EnvelopeSpectra;
using test::PeaksAt;
using test::period_turns;
using test::spectra_of;
using test::turning;

namespace {

constexpr double carrier = 30;

}  // namespace

SCENARIO("the envelope spectrum reads order and depth of a modulation", "[analysis][envelope]") {
  GIVEN("a carrier of order 30 whose amplitude of 1 swings by 0.4 at order 1") {
    const EnvelopeSpectra envelope = spectra_of(turning.modulated(carrier, 1, 0.4));
    THEN("the mean is 1, the line of order 1 is 0.4 high, and the highest") {
      CHECK(envelope.mean == Approx(1).epsilon(1e-3));
      CHECK(envelope.periods == 8);
      CHECK(envelope.whole.resolution == Approx(1.0 / (8 * period_turns)));
      CHECK_THAT(envelope.whole, PeaksAt(1));
      CHECK(envelope.whole.amplitude.maxCoeff() == Approx(0.4).epsilon(1e-3));
      CHECK(envelope.highest_order == Approx(carrier / 2).epsilon(0.01));
    }
  }
  GIVEN("a modulation that does not repeat with the gear train") {
    const EnvelopeSpectra envelope = spectra_of(turning.modulated(carrier, 2.3125, 0.4));
    THEN("taking the gear train out leaves it; of what is locked nothing is left") {
      const auto line = std::lround(2.3125 / envelope.whole.resolution);
      CHECK(envelope.unlocked.power[line] == Approx(envelope.lines.power[line]).epsilon(1e-3));
      const EnvelopeSpectra locked = spectra_of(turning.modulated(carrier, 1, 0.4));
      const auto shaft = std::lround(1 / locked.whole.resolution);
      CHECK(locked.unlocked.power[shaft] < 1e-6 * locked.lines.power[shaft]);
    }
  }
  GIVEN("a swing at order 800, of a shaft so slow that a turn takes 4960 samples") {
    const test::OrderSignals slow{.speed_Hz = 1, .rate_Hz = 4960, .count = 5 * 4960 + 1};
    const EnvelopeSpectra envelope =
        envelope_spectra(slow.modulated(1500, 800, 0.4), slow.rate_Hz, 0, slow.angle(), 1);
    THEN("it stands there, and at no order below") {
      const auto line = std::lround(800 / envelope.whole.resolution);
      CHECK(envelope.whole.amplitude[line] == Approx(0.4).epsilon(1e-2));
      CHECK(envelope.whole.amplitude.head(line - 10).maxCoeff() < 0.004);
    }
  }
  GIVEN("a record shorter than a period") {
    const Eigen::VectorXd x = turning.modulated(carrier, 1, 0.4).head(2000);
    THEN("there is no envelope") { CHECK(spectra_of(x).mean == 0); }
  }
}
