#include "analysis/quality/frozen_samples.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/analysis/order_signals.hpp"

using namespace rvbench;
using analysis::find_frozen_samples;

namespace {

constexpr Eigen::Index count = 100000;

Eigen::VectorXd rounded(const Eigen::VectorXd& x, double step) {
  return (x.array() / step).round() * step;
}

}  // namespace

TEST_CASE("samples that were replaced by zeros stand still", "[analysis][quality]") {
  const double step = GENERATE(1e-4, 0.1, 0.5);  // of noise of variance 1
  CAPTURE(step);
  Eigen::VectorXd x = rounded(test::white_noise(count, 1), step);
  CHECK_FALSE(find_frozen_samples(x));
  x.segment(40000, 100).setZero();
  const auto found = find_frozen_samples(x);
  REQUIRE(found);
  CHECK(std::abs(found->first - 40000) <= 4);  // a neighbour may be 0 by itself
  CHECK(std::abs(found->count - 100) <= 8);
  CHECK(found->usual <= 8);
}

TEST_CASE("a converter's coarse steps are no frozen samples", "[analysis][quality]") {
  // Of a slow sine a run at the crest is as long as it takes to fall by one step.
  const double period = GENERATE(100.0, 1000.0, 10000.0);
  const double step = GENERATE(0.001, 0.01, 0.1, 0.7);
  CAPTURE(period, step);
  CHECK_FALSE(find_frozen_samples(rounded(test::tone(1, count, period), step)));
}

TEST_CASE("vibration in a narrow band, coarsely quantised, is not frozen", "[analysis][quality]") {
  const double place = GENERATE(0.002, 0.02, 0.2);
  const double step = GENERATE(0.03, 0.3, 1.0);
  CAPTURE(place, step);
  const Eigen::VectorXd x = test::resonant(test::white_noise(count, 2), place, 0.05);
  CHECK_FALSE(find_frozen_samples(rounded(x, step * test::rms(x))));
}

TEST_CASE("samples that are all held for a while are not frozen", "[analysis][quality]") {
  const Eigen::VectorXd slow = test::white_noise(count / 16, 3);
  CHECK_FALSE(find_frozen_samples(slow.transpose().replicate(16, 1).reshaped()));
}

TEST_CASE("of few runs nothing is said", "[analysis][quality]") {
  CHECK_FALSE(find_frozen_samples(Eigen::VectorXd()));
  CHECK_FALSE(find_frozen_samples(Eigen::VectorXd::Zero(1000)));
  Eigen::VectorXd x = test::white_noise(1000, 4);
  x.tail(950).setZero();
  CHECK_FALSE(find_frozen_samples(x));
}
