#include "analysis/quality/spikes.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/analysis/order_signals.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::find_spikes;
using Indices = std::vector<Eigen::Index>;

namespace {

constexpr double rate_Hz = 12000;
constexpr Eigen::Index count = 60000;

// What a structure of one mode says when it is struck at these samples.
Eigen::VectorXd struck(const Indices& when, double mode_Hz, double damping) {
  Eigen::VectorXd blows = Eigen::VectorXd::Zero(count);
  for (const Eigen::Index i : when) blows[i] = 1;
  return test::resonant(blows, mode_Hz / rate_Hz, damping);
}

Indices every(Eigen::Index step) {
  Indices when;
  for (Eigen::Index i = step; i < count; i += step) when.push_back(i);
  return when;
}

}  // namespace

TEST_CASE("a jump of one or two samples is found, 40 times the noise around it",
          "[analysis][quality]") {
  Eigen::VectorXd x = test::white_noise(count, 3);
  x[20000] += 40;
  x[40000] -= 60;
  x[50000] += 100;
  x[50001] += 60;
  CHECK(find_spikes(x) == Indices{20000, 40000, 50000});
}

TEST_CASE("a slow vibration however strong hides no jump", "[analysis][quality]") {
  Eigen::VectorXd x = 50 * test::tone(30, count, rate_Hz) + 0.1 * test::white_noise(count, 4);
  x[30000] += 5;
  CHECK(find_spikes(x) == Indices{30000});
}

TEST_CASE("a structure that is struck rings, and is no jump", "[analysis][quality]") {
  const double mode_Hz = GENERATE(5.0, 60.0, 300.0, 1500.0, 3000.0, 4900.0, 5800.0);
  const double damping = GENERATE(0.005, 0.05, 0.1);
  CAPTURE(mode_Hz, damping);
  const Eigen::VectorXd ringing = struck(every(1117), mode_Hz, damping);
  CHECK(find_spikes(ringing).empty());
  CHECK(find_spikes(ringing + 1e-3 * test::white_noise(count, 5)).empty());
}

TEST_CASE("a faster decay than any structure's is what makes a jump", "[analysis][quality]") {
  CHECK(find_spikes(struck({9000}, 5800, 0.4)).size() == 1);
}

TEST_CASE("noise of any colour, and tones, have no jumps", "[analysis][quality]") {
  const unsigned seed = GENERATE(1u, 2u, 3u, 4u);
  const Eigen::VectorXd white = test::white_noise(count, seed);
  CHECK(find_spikes(white).empty());
  CHECK(find_spikes(test::reddened(white, 0.99)).empty());
  CHECK(find_spikes(test::resonant(white, 0.2, 0.01)).empty());
  CHECK(find_spikes(test::tone(1234.5, count, rate_Hz)).empty());
  // A vibration that comes and goes.
  CHECK(find_spikes(white.cwiseProduct(test::tone(3, count, rate_Hz))).empty());
}

TEST_CASE("single steps of a coarse converter are no jumps", "[analysis][quality]") {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(count);
  x[10000] = 1;
  x[30000] = -1;
  CHECK(find_spikes(x).empty());
  CHECK(find_spikes((0.4 * test::white_noise(count, 6)).array().round().matrix()).empty());
  x[10000] = 20;  // twenty steps
  CHECK(find_spikes(x) == Indices{10000});
}

TEST_CASE("too few samples have no surroundings, and a gap is refused", "[analysis][quality]") {
  CHECK(find_spikes(Eigen::VectorXd::Zero(50)).empty());
  CHECK(find_spikes(Eigen::VectorXd{}).empty());
  CHECK_THROWS_AS(find_spikes(Eigen::VectorXd::Constant(100, std::nan(""))), std::invalid_argument);
}
