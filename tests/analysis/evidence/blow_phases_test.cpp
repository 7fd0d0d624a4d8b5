#include "analysis/evidence/blow_phases.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/analysis/order_signals.hpp"
#include "tests/analysis/reducers.hpp"

using namespace rvbench;
using test::OrderSignals;

namespace {

const OrderSignals shaft{.speed_Hz = 30, .rate_Hz = 2400, .count = 38900};  // 4 periods of 121
constexpr double planet_order = 40.0 / 121;

// A planet's comb up to the third harmonic of its mesh, whose lines begin at these phases.
template <typename Phase>
Eigen::VectorXd comb(Phase phase) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(shaft.count);
  for (int h = 1; h <= 80; ++h) x += shaft.tone(h * planet_order, phase(h));
  return x;
}

double planet_phases(const Eigen::VectorXd& x) {
  const analysis::Kinematics k = test::rv20e();
  const analysis::OrderLines lines(shaft.channel(x), shaft.angle(), k.period_turns);
  const analysis::GearPlaces places =
      analysis::line_places(lines.turns(), lines.top_order(), shaft.speed_Hz, true, k);
  return analysis::blow_phases(lines, places, k)[test::index_of(k, "planet_gear")];
}

}  // namespace

TEST_CASE("lines in phase are a blow, and a delay of the blow changes nothing",
          "[analysis][evidence]") {
  const double at_once = planet_phases(comb([](int) { return 0.0; }));
  const double later = planet_phases(comb([](int h) { return -0.7 * h; }));
  CHECK(at_once > 5);
  CHECK(later == Approx(at_once).epsilon(0.02));
}

TEST_CASE("lines of random phases are none on average", "[analysis][evidence][null]") {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> any(0, 2 * std::numbers::pi);
  constexpr int draws = 60;
  double sum = 0;
  for (int i = 0; i < draws; ++i) {
    sum += planet_phases(comb([&](int) { return any(engine); }));
  }
  CHECK(std::abs(sum / draws) < 0.12);
}

TEST_CASE("noise is no blow", "[analysis][evidence][null]") {
  CHECK(std::abs(planet_phases(shaft.noise(5))) < 1);
}

TEST_CASE("only a part that strikes is asked for its phases", "[analysis][evidence]") {
  const analysis::Kinematics k = test::rv20e();
  const analysis::OrderLines lines(shaft.channel(shaft.noise(2)), shaft.angle(), k.period_turns);
  const analysis::GearPlaces places =
      analysis::line_places(lines.turns(), lines.top_order(), shaft.speed_Hz, true, k);
  const std::vector<double> phases = analysis::blow_phases(lines, places, k);
  REQUIRE(phases.size() == k.signatures.size());
  for (std::size_t s = 0; s < phases.size(); ++s) {
    CHECK(std::isnan(phases[s]) == !k.signatures[s].strikes);
  }
}
