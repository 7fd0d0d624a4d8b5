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

constexpr int comb_lines = 80;

// Of each line of a planet's comb, up to the third harmonic of its mesh: at phase 0 and a quarter
// later.
Eigen::MatrixXd tones() {
  Eigen::MatrixXd columns(shaft.count, 2 * comb_lines);
  for (int h = 1; h <= comb_lines; ++h) {
    columns.col(2 * h - 2) = shaft.tone(h * planet_order);
    columns.col(2 * h - 1) = shaft.tone(h * planet_order, std::numbers::pi / 2);
  }
  return columns;
}

// The comb, whose lines begin at these phases. One line may be so many times louder.
template <typename Phase>
Eigen::VectorXd comb(Phase phase, double loudest = 1) {
  static const Eigen::MatrixXd columns = tones();
  Eigen::VectorXd weights(2 * comb_lines);
  for (int h = 1; h <= comb_lines; ++h) {
    const double amplitude = h == 41 ? loudest : 1, at = phase(h);
    weights[2 * h - 2] = amplitude * std::cos(at);
    weights[2 * h - 1] = amplitude * std::sin(at);
  }
  return columns * weights;
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
  CHECK(at_once > 20);
  CHECK(later == Approx(at_once).epsilon(0.02));
}

// What is stated of random phases: no excess on average, a standard deviation of 1, and one in a
// hundred above 3. A line that is louder than all others leaves less to the phases.
TEST_CASE("random phases are none, by standard deviations of their own",
          "[analysis][evidence][null]") {
  const double loudest = GENERATE(1.0, 6.0);
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> any(0, 2 * std::numbers::pi);
  constexpr int draws = 100;
  double sum = 0, squares = 0;
  int above = 0;
  for (int i = 0; i < draws; ++i) {
    const double over = planet_phases(comb([&](int) { return any(engine); }, loudest));
    sum += over;
    squares += over * over;
    above += over > 3 ? 1 : 0;
  }
  CHECK(std::abs(sum / draws) < 0.3);
  CHECK(std::sqrt(squares / draws) == Approx(1).margin(0.35));
  CHECK(above <= 5);
}

TEST_CASE("noise is no blow", "[analysis][evidence][null]") {
  CHECK(std::abs(planet_phases(shaft.noise(5))) < 3);
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
