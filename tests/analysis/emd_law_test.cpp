#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/emd/emd.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::emd;

namespace {

// Response of the cardinal cubic spline through samples 1 apart to a tone of v cycles a sample.
double cardinal_response(double v) {
  const double angle_rad = std::numbers::pi * v;
  const double sinc = std::sin(angle_rad) / angle_rad;
  return std::pow(sinc, 4) * 3 / (2 + std::cos(2 * angle_rad));
}

// What of a weak tone at f times the strong tone's frequency is wrongly in IMF 1: each sift takes
// the mean of two splines through knots one period apart, which folds the weak tone to f + 2k.
double two_tone_law(double f, int sifts) {
  double fold = 0;
  for (int k = -20; k <= 20; ++k) fold += cardinal_response(f + 2 * k);
  double squares = 0;
  for (int k = -20; k <= 20; ++k) {
    const double left =
        (k == 0 ? 1 : 0) - cardinal_response(f + 2 * k) * (1 - std::pow(1 - fold, sifts)) / fold;
    squares += left * left;
  }
  return std::sqrt(squares);
}

// |IMF 1 - strong tone| over |weak tone|, in the middle half.
double two_tone_experiment(double f, double weak_amplitude, int sifts) {
  constexpr Eigen::Index samples = 64 * 600;
  const Eigen::VectorXd strong = test::tone(1, samples, 64);
  const Eigen::VectorXd weak = weak_amplitude * test::tone(f, samples, 64, 0.37);
  const Eigen::VectorXd left = emd(strong + weak, {.imfs = 1, .sifts = sifts}).imfs.col(0) - strong;
  const auto middle = [](const Eigen::VectorXd& x) { return x.segment(samples / 4, samples / 2); };
  return middle(left).norm() / middle(weak).norm();
}

}  // namespace

TEST_CASE("two tones part exactly as theory has it", "[analysis][emd][law][literature]") {
  // After Rilling & Flandrin, IEEE Trans. Signal Process. 56(1), 85-95 (2008), without their
  // approximations. The amplitude of 0.001 leaves 1e-4 of non-linearity.
  CHECK(two_tone_law(0.5, 10) == Approx(0.019709).margin(1e-6));
  CHECK(two_tone_law(0.65, 10) == Approx(0.460107).margin(1e-6));
  for (const int sifts : {1, 4, 10, 50}) {
    for (double f = 0.05; f < 0.96; f += 0.1) {
      CAPTURE(sifts, f);
      CHECK(two_tone_experiment(f, 0.001, sifts) == Approx(two_tone_law(f, sifts)).margin(1e-4));
    }
  }
  SECTION("half of the weak tone is parted at two thirds of the frequency") {
    CHECK(two_tone_experiment(0.655, 0.001, 10) < 0.5);
    CHECK(two_tone_experiment(0.665, 0.001, 10) > 0.5);
  }
}

TEST_CASE("a strong slow tone is parted only while it makes no extrema of its own",
          "[analysis][emd][literature]") {
  // The other regime of that paper: amplitude times frequency ratio squared below and above 1/2.
  CHECK(two_tone_experiment(0.3, 5, 10) == Approx(0.011).margin(0.001));
  CHECK(two_tone_experiment(0.4, 5, 10) == Approx(1.016).margin(0.005));
}

TEST_CASE("white noise falls into octaves", "[analysis][emd][literature]") {
  // Flandrin, Rilling & Gonçalvès, IEEE Signal Process. Lett. 11(2), 112-114 (2004). The figures
  // are those on which three independent programs agree, from 10 sifts of 49 600 samples.
  const double crossings_per_sample[] = {.6985, .3359, .1661, .0830, .0417, .0208, .0104};
  const double share_of_energy[] = {.633, .220, .109, .0566, .029, .0154, .0082};
  constexpr Eigen::Index samples = 49600;
  constexpr int imfs = 7, records = 10, records_of_literature = 5;
  Eigen::ArrayXXd crossings(records, imfs), energy(records, imfs);
  for (int record = 0; record < records; ++record) {
    const Eigen::ArrayXXd modes =
        emd(test::white_noise(samples, static_cast<unsigned>(record)), {.imfs = imfs}).imfs;
    REQUIRE(modes.cols() == imfs);
    const auto crosses = modes.topRows(samples - 1) * modes.bottomRows(samples - 1) < 0;
    crossings.row(record) = crosses.cast<double>().colwise().mean();
    energy.row(record) = modes.square().colwise().mean();
  }
  const auto agrees = [&](const Eigen::ArrayXd& found, double expected, double rounding) {
    const double variance = (found - found.mean()).square().sum() / (records - 1);
    const double error = std::sqrt(variance * (1. / records + 1. / records_of_literature));
    CAPTURE(expected, found.mean(), error);
    CHECK(std::abs(found.mean() - expected) < 3 * error + rounding);
    CHECK(error < 0.05 * expected);  // else the comparison would say nothing
  };
  for (int k = 0; k < imfs; ++k) {
    CAPTURE(k + 1);
    agrees(crossings.col(k), crossings_per_sample[k], 5e-5);
    agrees(energy.col(k), share_of_energy[k], 5e-4);
  }
}
