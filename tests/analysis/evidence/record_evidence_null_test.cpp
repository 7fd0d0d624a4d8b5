#include "tests/analysis/evidence/scored.hpp"
#include "tests/analysis/null_rates.hpp"
#include "tests/analysis/order_signals.hpp"
#include "tests/analysis/reducers.hpp"
#include "tests/support/under_sanitizer.hpp"

using namespace rvbench;
using analysis::EnvelopeSpectra;
using analysis::Kinematics;
using test::NoOftenerThanStated;
using test::NullDraws;
using test::OrderSignals;
using test::reddened;
using test::resonant;
using test::rv20e;
using test::UniformBelow;

namespace {

const OrderSignals turning{.speed_Hz = 30, .rate_Hz = 1920, .count = 30977};  // 4 output turns

// The p-values of each signature over draws of noise.
template <class Noise>
std::vector<NullDraws> draws_of(int draws, Noise noise) {
  const Kinematics k = rv20e();
  const analysis::ShaftAngle angle = turning.angle();
  std::vector<NullDraws> results(k.signatures.size());
  for (int seed = 1; seed <= draws; ++seed) {
    const EnvelopeSpectra envelope = envelope_spectra(noise(static_cast<unsigned>(seed)),
                                                      turning.rate_Hz, 0, angle, k.period_turns);
    const auto scores = test::scored({envelope}, k);
    for (std::size_t i = 0; i < scores.size(); ++i) {
      results[i].p_values.push_back(scores[i].p_value);
    }
  }
  return results;
}

void check_no_false_alarms(const std::vector<NullDraws>& draws) {
  const Kinematics k = rv20e();
  for (std::size_t i = 0; i < draws.size(); ++i) {
    CAPTURE(k.signatures[i].component, k.signatures[i].slip);
    CHECK_THAT(draws[i], NoOftenerThanStated({0.001, 0.01, 0.1, 0.5}));
  }
}

}  // namespace

TEST_CASE("in white noise no signature is significant oftener than stated",
          "[analysis][evidence][null]") {
  if (test::too_long_under_sanitizer()) return;
  const auto draws = draws_of(400, [](unsigned seed) { return turning.noise(seed); });
  check_no_false_alarms(draws);
  // Where no other part's lines are set off against it the p-value is exact.
  const Kinematics k = rv20e();
  for (std::size_t i = 0; i < draws.size(); ++i) {
    if (k.signatures[i].component != "input_shaft" && k.signatures[i].component != "crank")
      continue;
    CAPTURE(k.signatures[i].component);
    CHECK_THAT(draws[i], UniformBelow({0.01, 0.1, 0.5, 0.9}));
  }
}

TEST_CASE("nor is it in coloured noise", "[analysis][evidence][null]") {
  if (test::too_long_under_sanitizer()) return;
  SECTION("that falls from order 1 on") {
    check_no_false_alarms(
        draws_of(100, [](unsigned seed) { return reddened(turning.noise(seed), 0.9); }));
  }
  SECTION("that falls all the way") {
    check_no_false_alarms(
        draws_of(100, [](unsigned seed) { return reddened(turning.noise(seed), 0.99); }));
  }
  SECTION("that rings at 1 % of damping, as the mode of an IMF does") {
    check_no_false_alarms(
        draws_of(100, [](unsigned seed) { return resonant(turning.noise(seed), 0.2, 0.01); }));
  }
}

TEST_CASE("nor is it beside a mesh line without sidebands", "[analysis][evidence][null]") {
  check_no_false_alarms(draws_of(100, [](unsigned seed) {
    return Eigen::VectorXd(5 * turning.tone(1080.0 / 121) + turning.noise(seed));
  }));
}
