#include "analysis/quality/clipping.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::clipped_samples;

namespace {

constexpr double rate_Hz = 4960;
constexpr Eigen::Index count = 24800;

// Ten samples and more of each crest lie above 2.5, so each is a run.
Eigen::VectorXd swing() { return 3 * test::tone(87.3, count, rate_Hz); }

Eigen::VectorXd noise(double rms) { return rms * test::white_noise(count, 1); }

// As a converter gives it, in its steps.
Eigen::VectorXd converted(const Eigen::VectorXd& x) { return x.array().round(); }

}  // namespace

TEST_CASE("what a rail holds is counted, at either end", "[analysis][quality]") {
  const Eigen::Index above = (swing().array() >= 2.5).count();
  const Eigen::Index below = (swing().array() <= -2.5).count();
  REQUIRE(above > 3000);
  CHECK(clipped_samples(swing().cwiseMin(2.5)) == above);
  CHECK(clipped_samples(swing().cwiseMax(-2.5)) == below);
  CHECK(clipped_samples(swing().cwiseMin(2.5).cwiseMax(-2.5)) == above + below);
  CHECK(clipped_samples(swing().array().min(2.5) - 100) == above);
  CHECK(clipped_samples(1e-6 * swing().cwiseMin(2.5)) == above);
  CHECK(clipped_samples(swing()) == 0);
}

TEST_CASE("a converter's rail is seen through its steps", "[analysis][quality]") {
  const Eigen::VectorXd x = 300 * (swing() + noise(0.3));
  CHECK(clipped_samples(converted(x).cwiseMin(800)) > 2000);
  CHECK(clipped_samples(converted(x).cwiseMin(800).cwiseMax(-700)) > 5000);
  CHECK(clipped_samples(converted(x)) == 0);
}

TEST_CASE("a fast signal that goes from rail to rail is clipped", "[analysis][quality]") {
  // 3.2 samples a swing: no more than two in a row at one rail.
  const Eigen::VectorXd fast = test::tone(1563, count, rate_Hz);
  CHECK(clipped_samples(fast.cwiseMin(0.4).cwiseMax(-0.4)) > 5000);
  CHECK(clipped_samples(fast) == 0);
}

TEST_CASE("a fast signal that is clipped on one side never stays there, and is clipped",
          "[analysis][quality]") {
  // A resonance of 3.2 samples a swing: two in a row at the rail at most.
  const Eigen::VectorXd fast = test::tone(1563, count, rate_Hz) + noise(0.05);
  const Eigen::Index below = (fast.array() <= -0.9).count();
  REQUIRE(below > 3000);
  CHECK(clipped_samples(fast.cwiseMax(-0.9)) == below);
  CHECK(clipped_samples(-fast.cwiseMax(-0.9)) == below);
  CHECK(clipped_samples(converted(2000 * fast).cwiseMax(-1800)) >= below);
  CHECK(clipped_samples(fast.cwiseMax(-0.9).array() + 50) == below);
  CHECK(clipped_samples(fast) == 0);
  Eigen::VectorXd struck = fast.cwiseMax(-0.9);
  for (const Eigen::Index at : {100, 2000, 3000}) struck[at] = -2;
  CHECK(double(clipped_samples(struck)) > 0.99 * double(below));
}

TEST_CASE("white noise is clipped where its tail is one value", "[analysis][quality]") {
  const Eigen::VectorXd white = noise(1);
  const Eigen::Index above = (white.array() >= 2).count();
  REQUIRE(above > 400);
  CHECK(clipped_samples(white.cwiseMin(2)) == above);
  CHECK(clipped_samples(white) == 0);
}

TEST_CASE("extreme values of few bits come seldom, and are no rail", "[analysis][quality]") {
  // Standard deviations in steps of the converter: from hardly one step to nine bits. An offset
  // puts the mean between two steps, or leaves one side a step more.
  const double steps = GENERATE(0.3, 0.5, 1.0, 2.0, 4.0, 16.0, 100.0);
  const double offset = GENERATE(0.0, 0.3, 0.5, 1000.2);
  CAPTURE(steps, offset);
  CHECK(clipped_samples(converted(noise(steps).array() + offset)) == 0);
  const Eigen::VectorXd swings = steps * test::tone(1563, count, rate_Hz).array() + offset;
  CHECK(clipped_samples(converted(swings)) == 0);
  CHECK(clipped_samples(converted(swings + noise(0.1 * steps))) == 0);
  // Rare shocks over a quiet ground, to one side.
  Eigen::VectorXd shocks = converted(noise(steps).array() + offset);
  for (Eigen::Index i = 0; i < count; i += 310) shocks[i] += 100 * steps + double(i % 7);
  CHECK(clipped_samples(shocks) == 0);
}

TEST_CASE("glitches beyond a rail do not hide it", "[analysis][quality]") {
  Eigen::VectorXd x = (swing() + noise(0.3)).cwiseMin(2.5);
  const auto held = static_cast<double>(clipped_samples(x));
  REQUIRE(held > 2000);
  x[100] = 4;
  x[2000] = 2.6;
  x[3000] = -9;
  CHECK(double(clipped_samples(x)) > 0.99 * held);
}

TEST_CASE("crests of a converted signal are no rail", "[analysis][quality]") {
  const double steps = GENERATE(1.0, 2.0, 3.0, 5.0, 8.0, 20.0, 50.0, 100.0, 400.0, 3000.0);
  const double frequency_Hz =
      GENERATE(2.0, 31.0, rate_Hz / 32, 400.0, rate_Hz / 7, rate_Hz / 5, rate_Hz / 4, rate_Hz / 3);
  const double phase_rad = GENERATE(0.0, 0.1, 0.4);
  CAPTURE(steps, frequency_Hz, phase_rad);
  const Eigen::VectorXd x = steps * test::tone(frequency_Hz, count, rate_Hz, phase_rad);
  CHECK(clipped_samples(converted(x)) == 0);
  CHECK(clipped_samples(converted(x + noise(0.7))) == 0);
  CHECK(clipped_samples(converted(x + noise(0.2 * steps))) == 0);
}

TEST_CASE("plateaus are no rail", "[analysis][quality]") {
  SECTION("of a square wave, and of stairs") {
    const Eigen::VectorXd square = swing().array().sign();
    CHECK(clipped_samples(square) == 0);
    CHECK(clipped_samples(converted(test::tone(1, count, rate_Hz) * 3) * 100) == 0);
  }
  SECTION("where a slide stands at either end of its way") {
    // Half a cosine there and back, and as long at rest.
    const Eigen::VectorXd phase = 3 * test::tone(1, count, rate_Hz);
    const Eigen::VectorXd way = phase.cwiseMin(1.5).cwiseMax(-1.5) * std::numbers::pi / 3;
    CHECK(clipped_samples(way.array().sin()) == 0);
    CHECK(clipped_samples(converted(5000 * way.array().sin())) == 0);
  }
  SECTION("of a force that rests between its pulses") {
    const Eigen::VectorXd pulses = (test::tone(10, count, rate_Hz).array() - 0.9).cwiseMax(0);
    CHECK(clipped_samples(-pulses) == 0);
    CHECK(clipped_samples(converted(1e5 * pulses)) == 0);
  }
}
