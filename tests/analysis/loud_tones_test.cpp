#include "analysis/order/loud_tones.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/analysis/order_signals.hpp"

using namespace rvbench;
using analysis::OrderLines;
using analysis::without_loud_tones;
using test::OrderSignals;

namespace {

const OrderSignals shaft{.speed_Hz = 20, .rate_Hz = 2000, .count = 40000};

// Gears at whole orders; a sound machine has a mesh at 12.
double from_whole(double order) { return std::abs(order - std::round(order)); }
const std::vector<double> mesh{12, 24, 36};

std::optional<Channel> quiet(const Eigen::VectorXd& x) {
  const Channel channel = shaft.channel(x);
  const OrderLines lines(channel, shaft.angle(), 1);
  return without_loud_tones(channel, shaft.angle(), lines, mesh, from_whole);
}

double rms_of(const Eigen::VectorXd& x) { return test::rms(x); }

}  // namespace

TEST_CASE("a loud tone between the gears' lines is taken out, and nothing else",
          "[analysis][order]") {
  const Eigen::VectorXd gears = shaft.tone(12) + 0.3 * shaft.noise(3);
  const auto left = quiet(gears + 2 * shaft.tone(7.37, 0.3));
  REQUIRE(left);
  CHECK(rms_of(left->samples - gears) < 0.02);
}

TEST_CASE("what sounds with the gears stays, however loud", "[analysis][order]") {
  CHECK_FALSE(quiet(5 * shaft.tone(12) + 0.3 * shaft.noise(3)));
  CHECK_FALSE(quiet(5 * shaft.tone(7) + shaft.tone(12) + 0.3 * shaft.noise(3)));
}

TEST_CASE("a tone of less than a tenth of the power is left alone", "[analysis][order]") {
  CHECK_FALSE(quiet(shaft.tone(12) + 0.2 * shaft.tone(7.37) + 0.1 * shaft.noise(3)));
}
