#include "analysis/compare/block_floor.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/statistics.hpp"
#include "tests/analysis/null_rates.hpp"
#include "tests/support/signals.hpp"
#include "tests/support/under_sanitizer.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index count = 8000;

// The mean, in power, of independent blocks of white noise of variance 1.
Spectrum mean_of_blocks(int blocks, unsigned seed) {
  Eigen::VectorXd power = Eigen::VectorXd::Zero(count / 2 + 1);
  double resolution = 0;
  for (int i = 0; i < blocks; ++i) {
    const auto noise = test::white_noise(count, 100 * seed + static_cast<unsigned>(i));
    const Spectrum one = amplitude_spectrum(noise, 1000, Window::hann);
    resolution = one.resolution;
    power += one.amplitude.cwiseAbs2() / blocks;
  }
  return {resolution, power.cwiseSqrt()};
}

}  // namespace

TEST_CASE("the floor of a mean of blocks is the mean power, and p-values over it are uniform",
          "[analysis][null]") {
  const int blocks = GENERATE(1, 2, 4, 16);
  CAPTURE(blocks);
  constexpr unsigned draws = test::under_sanitizer ? 2 : 40;
  test::NullDraws over_floor;
  double mean = 0;
  for (unsigned seed = 1; seed <= draws; ++seed) {
    const LineFloor lines = block_floor(mean_of_blocks(blocks, seed), 0, blocks);
    mean += lines.floor.segment(200, count / 2 - 400).mean() / draws;
    for (Eigen::Index i = 200; i + 200 < lines.power.size(); i += 7) {
      over_floor.p_values.push_back(line_p_value(blocks * lines.power[i] / lines.floor[i], blocks,
                                                 blocks * lines.floor_lines[i]));
    }
  }
  if (test::under_sanitizer) return;
  // Hann lines of white noise of variance 1 have the mean power 4/n · 3/2.
  CHECK(mean == Approx(6.0 / static_cast<double>(count)).epsilon(0.02));
  CHECK_THAT(over_floor, test::UniformBelow({0.001, 0.01, 0.1, 0.5, 0.9}));
}

TEST_CASE("the median of noise lies below its mean, the less the more blocks there are",
          "[analysis]") {
  CHECK(noise_median(1) == std::log(2.0));
  // A gamma distribution of shape 2: (1 + x) exp(-x) = 1/2 at x = 1.67835.
  CHECK(noise_median(2) == Approx(1.67835 / 2).epsilon(1e-5));
  CHECK(noise_median(100) == Approx(1 - 1.0 / 300).epsilon(1e-4));
}

}  // namespace rvbench::analysis
