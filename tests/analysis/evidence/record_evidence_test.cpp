#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/analysis/eight_periods.hpp"
#include "tests/analysis/evidence/scored.hpp"
#include "tests/analysis/reducers.hpp"

using namespace rvbench;
using analysis::Kinematics;
using analysis::SignatureScore;
using test::period_turns;
using test::small_reducer;
using test::spectra_of;
using test::turning;

namespace {

constexpr double carrier = 30;

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

// What noise beside a carrier of 1 makes of an envelope line, in either direction: the envelope's
// noise is twice as dense as the signal's, for it has both sidebands, and a Hann line 1.5 lines
// wide.
double line_error(double noise) { return noise * std::sqrt(6 / double(turning.count)); }

// Three standard deviations of a family of so many lines of noise: the power of each is
// exponential, its mean is taken out. The best of a few hundred stretches of 4 or 12 lines stays
// below that of 70.
double depth_of_noise(double noise, double lines) {
  return std::sqrt(3 * 2 * std::pow(line_error(noise), 2) * std::sqrt(lines));
}

constexpr double resampling = 1e-3;           // relative: as ShaftAngle::resample() has it
constexpr double lines_of_a_family = 70;      // 23 harmonics of the planet, each with two sidebands
const double low = std::pow(10, -1.42 / 20);  // of a line between two, under a Hann window

void check_depth(double found, double modulated, double noise, double lowest = 1) {
  const double expected = depth_in_noise(modulated, noise * noise);
  const double error = 3 * line_error(noise) + resampling * modulated;
  CAPTURE(modulated, noise);
  CHECK(found < expected + error);
  CHECK(found > lowest * expected - error);
}

}  // namespace

TEST_CASE("a family's depth is the modulation's, in noise, too", "[analysis][evidence]") {
  const double depth = GENERATE(0.1, 0.3, 0.7);
  const double noise = GENERATE(0.0, 0.1);
  CAPTURE(depth, noise);
  const Eigen::VectorXd x = turning.modulated(carrier, 1, depth) + noise * turning.noise(1);
  const SignatureScore shaft = score_of("input_shaft", x);
  check_depth(shaft.depth, depth, noise);
  check_depth(shaft.line_depths.front(), depth, noise);
  CHECK(shaft.order == 1);
  CHECK(shaft.p_value < 1e-7);  // fifty errors high: what is left is the tail of 48 decoys
  // Its neighbours get nothing of it, though the sun's upper sideband is the shaft's line.
  const double nothing = depth_of_noise(noise, lines_of_a_family) + resampling * depth;
  CHECK(score_of("sun_gear", x).depth < nothing);
  CHECK(score_of("planet_gear", x).depth < nothing);
}

TEST_CASE("lines of one family add by power", "[analysis][evidence]") {
  const Eigen::VectorXd envelope =
      1 + 0.3 * turning.tone(1, 0.2).array() + 0.4 * turning.tone(2, 1.1).array();
  const Eigen::VectorXd x = envelope.cwiseProduct(turning.tone(carrier));
  const SignatureScore shaft = score_of("input_shaft", x);
  CHECK(shaft.depth == Approx(0.5).epsilon(resampling));
  REQUIRE(shaft.line_depths.size() == 2);
  CHECK(shaft.line_depths[0] == Approx(0.3).epsilon(resampling));
  CHECK(shaft.line_depths[1] == Approx(0.4).epsilon(resampling));
}

TEST_CASE("a steady carrier is silent", "[analysis][evidence]") {
  const Eigen::VectorXd x = turning.tone(carrier) + 0.1 * turning.noise(2);
  for (const auto& signature : small_reducer().signatures) {
    CAPTURE(signature.component);
    CHECK(score_of(signature.component, x).p_value > 1e-3);  // all nine in 99 of 100 draws
    CHECK(score_of(signature.component, x).depth < depth_of_noise(0.1, lines_of_a_family));
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
    CHECK(outer.p_value < 1e-9);  // a line of 250 errors
    // To half a line, for stretches are no denser.
    CHECK(outer.order == Approx(nominal * (1 + slip)).margin(0.5 / (8 * period_turns)));
    check_depth(outer.depth, 0.5, 0.1, low);
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
  // The same noise twice gains a third of a decade, taken for independent it would gain three.
  // Noise of its own gains 1.4. One draw of the former scatters by half a decade, of the latter by
  // one: the mean of 20 by 0.1 and 0.2, of which three are left to either side.
  CHECK(same == Approx(alone - 0.34).margin(0.3));
  CHECK(both == Approx(same - 1.4).margin(0.7));
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
  // It lies half-way between two lines and is told by either, to half a line.
  CHECK(outer->order == Approx(1.006 * nominal).margin((0.5 + 0.5) / (8 * period_turns)));
  CHECK(outer->channel == 0);
  REQUIRE(outer->channel_depths.size() == 3);
  check_depth(outer->channel_depths[0], 0.5, 0.1, low);
  check_depth(outer->channel_depths[1], 0.3, 0.1, low);
  // The envelope of noise alone is Rayleigh distributed: variance 4/π - 1 of the squared mean.
  const double rayleigh = std::sqrt(4 / std::numbers::pi - 1);
  CHECK(outer->channel_depths[2] < depth_of_noise(rayleigh, lines_of_a_family));
}
