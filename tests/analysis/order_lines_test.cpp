#include "analysis/order/order_lines.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/analysis/order_signals.hpp"

using namespace rvbench;
using analysis::OrderLines;
using test::OrderSignals;

namespace {

// 8 periods of 21 turns at 1280 samples a second: orders up to 25.6.
const OrderSignals turning{.speed_Hz = 20, .rate_Hz = 1280, .count = 10760};
constexpr double gear = 20.0 / 21;

OrderLines lines_of(const Eigen::VectorXd& x, double period_turns = 21) {
  return {turning.channel(x), turning.angle(), period_turns};
}

}  // namespace

TEST_CASE("a line reads the amplitude of its tone, line 0 the mean", "[analysis][order]") {
  const auto lines = lines_of(3 * turning.tone(11 * gear, 0.4).array() - 5);
  CHECK(lines.turns() == Approx(168));
  CHECK(lines.top_order() == Approx(25.6));
  const analysis::Spectrum spectrum = lines.spectrum();
  CHECK(spectrum.resolution == Approx(1.0 / 168));
  const auto line = [&](double order) {
    return spectrum.amplitude[std::lround(order / spectrum.resolution)];
  };
  CHECK(line(11 * gear) == Approx(3).epsilon(1e-3));
  CHECK(line(0) == Approx(5).epsilon(1e-3));
  CHECK(line(4 / 168.0) < 1e-3);  // the mean leaks into none
}

TEST_CASE("a band holds its own tone, and neither the mean nor others", "[analysis][order]") {
  const auto lines = lines_of(2 * turning.tone(4).array() + turning.tone(12).array() + 7);
  const auto band_rms = [&](double from, double to) { return test::rms(lines.between(from, to)); };
  CHECK(band_rms(3, 5) == Approx(2 / std::sqrt(2)).epsilon(1e-3));
  CHECK(band_rms(11, 13) == Approx(1 / std::sqrt(2)).epsilon(1e-3));
  CHECK(band_rms(0, 3) < 1e-2);
  CHECK(lines.between(3, 5).cwiseAbs().maxCoeff() == Approx(2).epsilon(0.08));
  CHECK(lines.between(26, 30).size() == 0);  // beyond what the record holds
}

TEST_CASE("the average of a gear keeps what repeats with its turns", "[analysis][order]") {
  // The stranger at 3/21 beside the mesh comes seven gear turns later as it was: not each turn.
  const auto lines = lines_of(turning.tone(12 * gear) + turning.tone(12 * gear + 3.0 / 21) +
                              turning.tone(9.0 / 21));
  const Eigen::VectorXd average = lines.average_turn(gear);
  REQUIRE(average.size() > 24);
  const Eigen::VectorXd mesh = test::tone(12, average.size(), double(average.size()));
  CHECK((average - mesh).cwiseAbs().maxCoeff() < 5e-3);
}

TEST_CASE("a record that is no whole number of a gear's turns loses less than 1 % of its mesh",
          "[analysis][order]") {
  // 168 turns of the input are 72.4 of a gear of 19 and 44.1 teeth: the rest is left out.
  const double order = 19 / 44.1;
  const auto lines = lines_of(turning.tone(19 * order), 1);
  const Eigen::VectorXd average = lines.average_turn(order);
  CHECK(test::rms(average) == Approx(1 / std::sqrt(2)).epsilon(0.01));
}

TEST_CASE("at a high rate and a low speed nothing is folded onto low orders", "[analysis][order]") {
  // 20480 samples a turn.
  const OrderSignals slow{.speed_Hz = 1, .rate_Hz = 20480, .count = 5 * 20480 + 1};
  const OrderLines lines(slow.channel(slow.tone(8000)), slow.angle(), 1);
  CHECK(lines.top_order() == Approx(0.4 * 20480));
  const analysis::Spectrum spectrum = lines.spectrum();
  const auto upto = [&](double order) { return std::lround(order / spectrum.resolution); };
  CHECK(spectrum.amplitude[upto(8000)] == Approx(1).epsilon(2e-3));
  CHECK(spectrum.amplitude.head(upto(7990)).maxCoeff() < 2e-3);
}

TEST_CASE("a gear that turned thrice has no average, a record without a period no lines",
          "[analysis][order]") {
  CHECK(lines_of(turning.tone(4)).average_turn(3.5 / 168).size() == 0);
  CHECK(lines_of(turning.tone(4)).average_turn(4.0 / 168).size() > 0);
  CHECK(lines_of(turning.tone(4), 200).empty());
  CHECK(lines_of(turning.tone(4), 200).average_turn(1).size() == 0);
}
