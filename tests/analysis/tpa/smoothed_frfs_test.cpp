#include "analysis/tpa/smoothed_frfs.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/analysis/tpa/random_matrices.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using Eigen::Index;

namespace {

constexpr Index rows = 12, columns = 6, lines = 161;

struct Mode {
  double frequency_Hz, damping_ratio;
};

/// Accelerance of modes at 1/4 Hz steps from 5 Hz on, with shapes by chance.
FrfMatrix structure(const std::vector<Mode>& modes, unsigned seed = 1) {
  FrfMatrix frfs;
  frfs.first_Hz = 5;
  frfs.step_Hz = 0.25;
  frfs.values = LineMatrices(rows, columns, lines);
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const Eigen::MatrixXcd shape =
        test::complex_noise(rows, 1, seed + 10 * unsigned(i)).real() *
        test::complex_noise(columns, 1, seed + 500 + unsigned(i)).real().transpose();
    for (Index line = 0; line < lines; ++line) {
      const double r = frfs.frequency_Hz(line) / modes[i].frequency_Hz;
      frfs.values[line] +=
          shape * (-r * r / std::complex<double>(1 - r * r, 2 * modes[i].damping_ratio * r));
    }
  }
  return frfs;
}

const std::vector<Mode> arm{{10.6, 0.03}, {14, 0.028}, {21.9, 0.032}, {36, 0.023}, {49, 0.035}};

FrfMatrix with_noise(FrfMatrix frfs, double deviation, unsigned seed) {
  frfs.values.values += deviation * test::complex_noise(frfs.values.values.size(), 1, seed);
  return frfs;
}

double off(const FrfMatrix& a, const FrfMatrix& b) {
  return (a.values.values - b.values.values).norm() / std::sqrt(double(a.values.values.size()));
}

}  // namespace

TEST_CASE("smoothing takes most of the noise out of FRFs, and says how much there was", "[tpa]") {
  constexpr double deviation = 0.01;
  const unsigned seed = GENERATE(range(1u, 4u));
  const FrfMatrix exact = structure(arm, seed);
  const FrfMatrix smooth = smooth_frfs(with_noise(exact, deviation, seed + 50), 1).frfs;
  // Ten coefficients of 25 lines, four of them shared by 72 elements: 6/25 of the variance is left,
  // more at the ends.
  CHECK(off(smooth, exact) < 0.6 * deviation);
  const double told = std::sqrt(smooth.noise.mean());
  CHECK(told == Approx(off(smooth, exact)).epsilon(0.1));
  CHECK(smooth.noise.rows() == rows * columns);
  CHECK(smooth.noise.cols() == lines);
}

TEST_CASE("resonances are left as they are", "[tpa]") {
  const FrfMatrix exact = structure(arm);
  double largest = 0;
  const FrfMatrix smooth = smooth_frfs(exact, 1).frfs;
  for (Index line = 0; line < lines; ++line) {
    largest = std::max(
        largest, (smooth.values[line] - exact.values[line]).norm() / exact.values[line].norm());
  }
  CHECK(largest < 1e-3);
}

TEST_CASE("where more resonances are close than can be fitted, the measured values stay", "[tpa]") {
  const std::vector<Mode> crowd{{20, 0.002},   {20.7, 0.002}, {21.3, 0.002}, {22, 0.002},
                                {22.8, 0.002}, {23.5, 0.002}, {24.1, 0.002}};
  const FrfMatrix exact = structure(crowd);
  const FrfMatrix smooth = smooth_frfs(with_noise(exact, 1e-3, 7), 1).frfs;
  for (Index line = 60; line <= 76; ++line) {
    CAPTURE(exact.frequency_Hz(line));
    CHECK((smooth.values[line] - exact.values[line]).norm() < 0.02 * exact.values[line].norm());
  }
}

TEST_CASE("noise alone gets smaller and no resonance is seen in it", "[tpa][null]") {
  FrfMatrix nothing = structure({});
  const FrfMatrix smooth = smooth_frfs(with_noise(nothing, 1, 3), 1).frfs;
  CHECK(off(smooth, nothing) < 0.6);
  CHECK(smooth.values.values.cwiseAbs().maxCoeff() < 4);
}

TEST_CASE("exact FRFs without resonances, and silent ones, stay as they are", "[tpa][null]") {
  FrfMatrix silent = structure({});
  CHECK(smooth_frfs(silent, 1).frfs.values.values.norm() == 0);
  FrfMatrix flat = silent;
  flat.values.values.setConstant({2, 1});
  const FrfMatrix smooth = smooth_frfs(flat, 1).frfs;
  CHECK((smooth.values.values - flat.values.values).norm() < 1e-9);
  CHECK(smooth.noise.maxCoeff() < 1e-18);
}

TEST_CASE("what hits differ by alike at all lines stays in the variances, noise leaves them",
          "[tpa]") {
  FrfMatrix frfs = with_noise(structure(arm), 0.01, 4);
  frfs.variances = Eigen::MatrixXd::Constant(rows * columns, lines, 4e-4 + 1e-4);
  const FrfMatrix smooth = smooth_frfs(frfs, 1).frfs;
  const double noise_left = off(smooth, structure(arm));
  CHECK(smooth.variances.mean() == Approx(4e-4 + noise_left * noise_left).epsilon(0.05));
}

TEST_CASE("too few lines are returned as they are", "[tpa]") {
  FrfMatrix few = structure(arm);
  few.values = LineMatrices(rows, columns, 24);
  few.values.values = test::complex_noise(rows * columns * 24, 1, 1);
  const FrfMatrix same = smooth_frfs(few, 1).frfs;
  CHECK(same.values.values == few.values.values);
  CHECK(same.noise.size() == 0);
  few.values.values[3] = std::nan("");
  CHECK_THROWS_AS(smooth_frfs(few, 1).frfs, std::invalid_argument);
}

TEST_CASE("smoothing does not depend on the number of threads", "[tpa]") {
  const FrfMatrix frfs = with_noise(structure(arm), 0.01, 9);
  CHECK(smooth_frfs(frfs, 1).frfs.values.values == smooth_frfs(frfs, 3).frfs.values.values);
}

TEST_CASE("other elements are smoothed as the FRFs were", "[tpa]") {
  const FrfMatrix noisy = with_noise(structure(arm), 0.01, 5);
  const SmoothedFrfs smooth = smooth_frfs(noisy, 1);
  const Eigen::MatrixXcf elements =
      Eigen::Map<const Eigen::MatrixXcd>(noisy.values.values.data(), rows * columns, lines)
          .cast<std::complex<float>>();
  const Eigen::MatrixXcf alike = smoothed_alike(elements, smooth.lines);
  const auto expected =
      Eigen::Map<const Eigen::MatrixXcd>(smooth.frfs.values.values.data(), rows * columns, lines);
  CHECK((alike.cast<std::complex<double>>() - expected).norm() < 1e-5 * expected.norm());
  CHECK_THROWS_AS(smoothed_alike(elements.leftCols(9), smooth.lines), std::invalid_argument);
  CHECK(smoothed_alike(elements, {}) == elements);
}
