#include "analysis/envelope_lines.hpp"

#include <catch2/catch.hpp>

#include "analysis/rv_reducer.hpp"
#include "tests/analysis/order_signals.hpp"
#include "tests/support/spectrum_matchers.hpp"

using namespace rvbench;
using analysis::EnvelopeSpectra;
using analysis::FamilyScore;
using analysis::Kinematics;
using test::OrderSignals;
using test::PeaksAt;

namespace {

constexpr double period_turns = 21;
constexpr double carrier = 30;
const OrderSignals turning{.speed_Hz = 20, .rate_Hz = 2000, .count = 16801};  // 8 periods

// i = 21: sun at 20/21, crank 10/21, in the housing 9/21.
Kinematics small_reducer() {
  return analysis::rv_reducer("small", {12, 24, 2, 9, 10}, {11, 5, 26, 0});
}

EnvelopeSpectra spectra_of(const Eigen::VectorXd& x) {
  return envelope_spectra(x, turning.rate_Hz, 0, turning.angle(), period_turns);
}

FamilyScore score_of(const std::string& component, const Eigen::VectorXd& x) {
  const Kinematics k = small_reducer();
  const EnvelopeSpectra envelope = spectra_of(x);
  const auto lines = signature_lines(k, envelope.whole.resolution);
  const auto scores = score_families(envelope, k.signatures, lines);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (k.signatures[i].component == component) return scores[i];
  }
  FAIL("no " << component);
  return {};
}

double order_of(const std::string& component) {
  for (const auto& s : small_reducer().signatures) {
    if (s.component == component) return s.order;
  }
  return 0;
}

// Depth that an envelope 1 + m·cos shows in Gaussian noise of variance v: noise lifts a Rician
// envelope A by v/(2A), most where it is low.
double depth_in_noise(double m, double v) {
  const double root = std::sqrt(1 - m * m);
  return (m + v / root * (root - 1) / m) / (1 + v / (2 * root));
}

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
  GIVEN("a record shorter than a period") {
    const Eigen::VectorXd x = turning.modulated(carrier, 1, 0.4).head(2000);
    THEN("there is no envelope") { CHECK(spectra_of(x).mean == 0); }
  }
}

TEST_CASE("a family's depth is the modulation's, in noise, too", "[analysis][envelope]") {
  const double depth = GENERATE(0.1, 0.3, 0.7);
  const double noise = GENERATE(0.0, 0.1);
  CAPTURE(depth, noise);
  const Eigen::VectorXd x = turning.modulated(carrier, 1, depth) + noise * turning.noise(1);
  const FamilyScore shaft = score_of("input_shaft", x);
  // Noise of 0.1 moves a line by 0.1·√(6/n) = 0.002, in either direction.
  const double expected = depth_in_noise(depth, noise * noise);
  CHECK(shaft.depth == Approx(expected).margin(0.006));
  CHECK(shaft.line_depths.front() == Approx(expected).margin(0.006));
  CHECK(shaft.order == 1);
  CHECK(shaft.p_value < 1e-9);
  // Its neighbours get nothing of it, though the sun's upper sideband is the shaft's line.
  CHECK(score_of("sun_gear", x).depth < 0.02);
  CHECK(score_of("planet_gear", x).depth < 0.02);
}

TEST_CASE("lines of one family add by power", "[analysis][envelope]") {
  const Eigen::VectorXd envelope =
      1 + 0.3 * turning.tone(1, 0.2).array() + 0.4 * turning.tone(2, 1.1).array();
  const Eigen::VectorXd x = envelope.cwiseProduct(turning.tone(carrier));
  const FamilyScore shaft = score_of("input_shaft", x);
  CHECK(shaft.depth == Approx(0.5).epsilon(0.01));
  REQUIRE(shaft.line_depths.size() == 2);
  CHECK(shaft.line_depths[0] == Approx(0.3).epsilon(0.01));
  CHECK(shaft.line_depths[1] == Approx(0.4).epsilon(0.01));
}

TEST_CASE("a steady carrier is silent", "[analysis][envelope]") {
  const Eigen::VectorXd x = turning.tone(carrier) + 0.1 * turning.noise(2);
  for (const auto& signature : small_reducer().signatures) {
    CAPTURE(signature.component);
    CHECK(score_of(signature.component, x).p_value > 1e-3);
    CHECK(score_of(signature.component, x).depth < 0.03);
  }
}

TEST_CASE("a rolling part is found within its slip, and not beyond it", "[analysis][envelope]") {
  const double nominal = order_of("bearing_outer");
  const auto modulated_at = [&](double slip) {
    return Eigen::VectorXd(turning.modulated(carrier, nominal * (1 + slip), 0.5) +
                           0.1 * turning.noise(3));
  };
  // None within two lines of a multiple of 1/21, where taking the gear train out takes some of it.
  for (const double slip : {-0.015, 0.0, 0.006}) {
    CAPTURE(slip);
    const FamilyScore outer = score_of("bearing_outer", modulated_at(slip));
    CHECK(outer.p_value < 1e-9);
    // To half a line, and read up to 1.42 dB low between lines.
    CHECK(outer.order == Approx(nominal * (1 + slip)).margin(0.5 / (8 * period_turns)));
    CHECK(outer.depth < 0.51);
    CHECK(outer.depth > 0.5 * std::pow(10, -1.42 / 20) - 0.01);
  }
  CHECK(score_of("bearing_outer", modulated_at(0.06)).p_value > 1e-3);
}

TEST_CASE("what repeats with the gear train is not taken for a rolling part",
          "[analysis][envelope]") {
  const double nominal = order_of("bearing_inner");
  const double locked = std::round(nominal * period_turns) / period_turns;
  REQUIRE(std::abs(locked / nominal - 1) < 0.02);
  const Eigen::VectorXd x = turning.modulated(carrier, locked, 0.5) + 0.1 * turning.noise(4);
  CHECK(score_of("bearing_inner", x).p_value > 1e-3);
}

TEST_CASE("depth does not depend on the unit", "[analysis][envelope]") {
  const Eigen::VectorXd x = turning.modulated(carrier, 1, 0.3) + 0.1 * turning.noise(5);
  const FamilyScore in_m_s2 = score_of("input_shaft", x);
  const FamilyScore in_m_us2 = score_of("input_shaft", 1e-6 * x);
  CHECK(in_m_us2.depth == Approx(in_m_s2.depth));
  CHECK(in_m_us2.statistic == Approx(in_m_s2.statistic));
}
