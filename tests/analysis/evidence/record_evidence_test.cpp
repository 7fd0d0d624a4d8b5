#include <catch2/catch.hpp>

#include "analysis/rv_reducer.hpp"
#include "tests/analysis/evidence/scored.hpp"
#include "tests/analysis/order_signals.hpp"

using namespace rvbench;
using analysis::EnvelopeSpectra;
using analysis::Kinematics;
using analysis::SignatureScore;
using test::OrderSignals;

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

SignatureScore score_of(const std::string& component, const Eigen::VectorXd& x) {
  const Kinematics k = small_reducer();
  const auto scores = test::scored({spectra_of(x)}, k);
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

TEST_CASE("a family's depth is the modulation's, in noise, too", "[analysis][evidence]") {
  const double depth = GENERATE(0.1, 0.3, 0.7);
  const double noise = GENERATE(0.0, 0.1);
  CAPTURE(depth, noise);
  const Eigen::VectorXd x = turning.modulated(carrier, 1, depth) + noise * turning.noise(1);
  const SignatureScore shaft = score_of("input_shaft", x);
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

TEST_CASE("lines of one family add by power", "[analysis][evidence]") {
  const Eigen::VectorXd envelope =
      1 + 0.3 * turning.tone(1, 0.2).array() + 0.4 * turning.tone(2, 1.1).array();
  const Eigen::VectorXd x = envelope.cwiseProduct(turning.tone(carrier));
  const SignatureScore shaft = score_of("input_shaft", x);
  CHECK(shaft.depth == Approx(0.5).epsilon(0.01));
  REQUIRE(shaft.line_depths.size() == 2);
  CHECK(shaft.line_depths[0] == Approx(0.3).epsilon(0.01));
  CHECK(shaft.line_depths[1] == Approx(0.4).epsilon(0.01));
}

TEST_CASE("a steady carrier is silent", "[analysis][evidence]") {
  const Eigen::VectorXd x = turning.tone(carrier) + 0.1 * turning.noise(2);
  for (const auto& signature : small_reducer().signatures) {
    CAPTURE(signature.component);
    CHECK(score_of(signature.component, x).p_value > 1e-3);
    CHECK(score_of(signature.component, x).depth < 0.03);
  }
}

TEST_CASE("a rolling part is found within its slip, and not beyond it", "[analysis][evidence]") {
  const double nominal = order_of("bearing_outer");
  const auto modulated_at = [&](double slip) {
    return Eigen::VectorXd(turning.modulated(carrier, nominal * (1 + slip), 0.5) +
                           0.1 * turning.noise(3));
  };
  // None within two lines of a multiple of 1/21, where taking the gear train out takes some of it.
  for (const double slip : {-0.015, 0.0, 0.006}) {
    CAPTURE(slip);
    const SignatureScore outer = score_of("bearing_outer", modulated_at(slip));
    CHECK(outer.p_value < 1e-9);
    // To half a line, and read up to 1.42 dB low between lines.
    CHECK(outer.order == Approx(nominal * (1 + slip)).margin(0.5 / (8 * period_turns)));
    CHECK(outer.depth < 0.51);
    CHECK(outer.depth > 0.5 * std::pow(10, -1.42 / 20) - 0.01);
  }
  CHECK(score_of("bearing_outer", modulated_at(0.06)).p_value > 1e-3);
}

TEST_CASE("what repeats with the gear train is not taken for a rolling part",
          "[analysis][evidence]") {
  const double nominal = order_of("bearing_inner");
  const double locked = std::round(nominal * period_turns) / period_turns;
  REQUIRE(std::abs(locked / nominal - 1) < 0.02);
  const Eigen::VectorXd x = turning.modulated(carrier, locked, 0.5) + 0.1 * turning.noise(4);
  CHECK(score_of("bearing_inner", x).p_value > 1e-3);
}

TEST_CASE("depth does not depend on the unit", "[analysis][evidence]") {
  const Eigen::VectorXd x = turning.modulated(carrier, 1, 0.3) + 0.1 * turning.noise(5);
  const SignatureScore in_m_s2 = score_of("input_shaft", x);
  const SignatureScore in_m_us2 = score_of("input_shaft", 1e-6 * x);
  CHECK(in_m_us2.depth == Approx(in_m_s2.depth));
  CHECK(in_m_us2.log_likelihood_ratio == Approx(in_m_s2.log_likelihood_ratio));
}

TEST_CASE("channels add their evidence, and pay for the noise that they share",
          "[analysis][evidence]") {
  const Kinematics k = small_reducer();
  REQUIRE(k.signatures.front().component == "input_shaft");
  const auto heard = [&](unsigned seed) {
    return spectra_of(turning.modulated(carrier, 1, 0.05) + 0.5 * turning.noise(seed));
  };
  double alone = 0, same = 0, both = 0;  // mean log10 of p
  constexpr unsigned draws = 20;
  for (unsigned seed = 1; seed <= draws; ++seed) {
    const auto x = heard(seed), y = heard(100 + seed);
    alone += std::log10(test::scored({x}, k).front().p_value) / draws;
    same += std::log10(test::scored({x, x}, k).front().p_value) / draws;
    both += std::log10(test::scored({x, y}, k).front().p_value) / draws;
  }
  CHECK(same == Approx(alone).margin(0.5));
  CHECK(both < same - 1);
}

TEST_CASE("a part that slips does so by one order in all channels", "[analysis][evidence]") {
  const double nominal = order_of("bearing_outer");
  const Kinematics k = small_reducer();
  const Eigen::VectorXd x = turning.modulated(carrier, 1.006 * nominal, 0.5);
  const Eigen::VectorXd y = turning.modulated(1.5 * carrier, 1.006 * nominal, 0.3);
  const auto scores =
      test::scored({spectra_of(x + 0.1 * turning.noise(8)), spectra_of(y + 0.1 * turning.noise(9)),
                    spectra_of(turning.noise(10))},
                   k);
  const auto outer = std::find_if(scores.begin(), scores.end(), [&](const SignatureScore& score) {
    return k.signatures[static_cast<std::size_t>(score.signature)].component == "bearing_outer";
  });
  REQUIRE(outer != scores.end());
  CHECK(outer->order == Approx(1.006 * nominal).margin(1.0 / (8 * period_turns)));
  CHECK(outer->channel == 0);
  REQUIRE(outer->channel_depths.size() == 3);
  CHECK(outer->channel_depths[0] == Approx(0.5).epsilon(0.05));
  CHECK(outer->channel_depths[1] == Approx(0.3).epsilon(0.05));
  CHECK(outer->channel_depths[2] < 0.06);
}
