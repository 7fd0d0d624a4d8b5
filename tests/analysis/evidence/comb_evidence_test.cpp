#include "analysis/evidence/comb_evidence.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

using namespace rvbench;
using analysis::CombEvidence;
using analysis::EnvelopeSpectra;
using analysis::SignatureComb;

namespace {

constexpr double resolution = 0.01;

// Lines at orders 1, 2, ..., one place each, in a spectrum whose floor is 1.
SignatureComb comb_of(int lines, bool rolls = false) {
  analysis::Kinematics k;
  k.signatures.resize(1);
  k.signatures[0].order = 1;
  k.signatures[0].harmonics = lines;
  SignatureComb comb = analysis::signature_combs(k, resolution).front();
  comb.rolls = rolls;
  return comb;
}

// An envelope with a mean of 10 and a known floor.
EnvelopeSpectra envelope_of(const Eigen::VectorXd& power, double floor_lines) {
  EnvelopeSpectra e;
  e.mean = 10;
  e.highest_order = 1000;
  e.whole.resolution = resolution;
  e.lines = {power, Eigen::VectorXd::Ones(power.size()),
             Eigen::VectorXd::Constant(power.size(), floor_lines),
             Eigen::VectorXd::Constant(power.size(), 3 * floor_lines), 0};
  e.unlocked = e.lines;
  return e;
}

Eigen::VectorXd silence_but(Eigen::Index line, double power) {
  Eigen::VectorXd x = Eigen::VectorXd::Ones(2000);
  x[line] = power;
  return x;
}

}  // namespace

TEST_CASE("the log ratio of a line is its power over a floor that is known well",
          "[analysis][evidence]") {
  const CombEvidence e = comb_evidence(envelope_of(silence_but(100, 50), 1e9), comb_of(2));
  CHECK(e.log_ratio(0, 0) == Approx(50));
  CHECK(e.log_ratio(1, 0) == Approx(1));
  CHECK(e.depth2(0, 0) == Approx((50 - 1) / 100.0));
  CHECK(e.depth2(1, 0) == Approx(0).margin(1e-12));
  CHECK(e.variance(0, 0) == Approx((1 + 2 * 49) / 1e4));
}

TEST_CASE("of a floor from few lines it grows with the logarithm", "[analysis][evidence]") {
  const CombEvidence e = comb_evidence(envelope_of(silence_but(100, 50), 10), comb_of(1));
  CHECK(e.log_ratio(0, 0) == Approx(10 * std::log(6)));
}

TEST_CASE("noise has a log ratio that is exponential with mean 1, however few lines give the floor",
          "[analysis][evidence][null]") {
  const int floor_lines = GENERATE(3, 30);
  CAPTURE(floor_lines);
  std::mt19937 engine(1);
  std::exponential_distribution<double> draw;
  int above_1 = 0, above_3 = 0;
  constexpr int draws = 20000;
  for (int i = 0; i < draws; ++i) {
    EnvelopeSpectra e = envelope_of(silence_but(100, draw(engine)), floor_lines);
    double floor = 0;
    for (int k = 0; k < floor_lines; ++k) floor += draw(engine) / floor_lines;
    e.lines.floor.setConstant(floor);
    const double ratio = comb_evidence(e, comb_of(1)).log_ratio(0, 0);
    above_1 += ratio > 1 ? 1 : 0;
    above_3 += ratio > 3 ? 1 : 0;
  }
  const auto give = [](double share) { return 4 * std::sqrt(share * (1 - share) * draws); };
  CHECK(above_1 == Approx(std::exp(-1) * draws).margin(give(std::exp(-1))));
  CHECK(above_3 == Approx(std::exp(-3) * draws).margin(give(std::exp(-3))));
}

TEST_CASE("a line of what rolls is as deep between two lines as on one", "[analysis][evidence]") {
  // A Hann window spreads an amplitude of 1 as 1/2, 1, 1/2 on a line, and midway between two as
  // 8/(15π), 8/(3π), 8/(3π): powers of 1.5 and of 1.47.
  const auto squared = [](double a) { return 16 * a * a; };
  const double far = squared(8 / (15 * std::numbers::pi));
  const double near = squared(8 / (3 * std::numbers::pi));
  const auto depth2_of = [](const Eigen::Vector3d& lobe) {
    Eigen::VectorXd power = Eigen::VectorXd::Ones(2000);
    power.segment(99, 3) += lobe;
    return comb_evidence(envelope_of(power, 100), comb_of(1, true)).depth2(0, 0) * 100;
  };
  CHECK(depth2_of({4, 16, 4}) == Approx(16));
  CHECK(depth2_of({far, near, near}) == Approx(16 * 1.47 / 1.5).epsilon(1e-3));
}

TEST_CASE("nothing speaks beyond half the carrier", "[analysis][evidence]") {
  EnvelopeSpectra e = envelope_of(silence_but(200, 1e6), 100);
  e.highest_order = 1.5;
  const CombEvidence read = comb_evidence(e, comb_of(2));
  CHECK(read.log_ratio(0, 0) > 0);
  CHECK(read.log_ratio(1, 0) == 0);
  CHECK(read.depth2(1, 0) == 0);
}

TEST_CASE("squared depths scatter in noise by the variance that is stated",
          "[analysis][evidence]") {
  // A line of known amplitude in complex white noise, under a Hann window: line k of the spectrum
  // is that of the noise less half of each neighbour.
  const bool rolls = GENERATE(false, true);
  const double amplitude = GENERATE(0.0, 20.0);
  CAPTURE(rolls, amplitude);
  std::mt19937 engine(2);
  std::normal_distribution<double> normal;
  constexpr int draws = 4000;
  double sum = 0, sum2 = 0, stated = 0;
  for (int draw = 0; draw < draws; ++draw) {
    std::array<std::complex<double>, 5> noise;
    for (auto& n : noise) n = std::complex<double>(normal(engine), normal(engine)) / std::sqrt(3);
    noise[2] += amplitude;
    Eigen::VectorXd power = Eigen::VectorXd::Ones(2000);
    for (std::size_t k = 1; k < 4; ++k) {
      power[98 + Eigen::Index(k)] = std::norm(noise[k] - 0.5 * (noise[k - 1] + noise[k + 1]));
    }
    const CombEvidence e = comb_evidence(envelope_of(power, 1e6), comb_of(1, rolls));
    sum += e.depth2(0, 0) / draws;
    sum2 += e.depth2(0, 0) * e.depth2(0, 0) / draws;
    stated += e.variance(0, 0) / draws;
  }
  // A variance is known to 4·√(2/draws) of itself. Without a line what noise lifts is taken for
  // one, which errs to the safe side: by 2/e, the mean that noise has above its floor, for one
  // line.
  const double scatter = sum2 - sum * sum;
  if (amplitude > 0) {
    CHECK(scatter == Approx(stated).epsilon(4 * std::sqrt(2.0 / draws)));
  } else {
    CHECK(scatter < stated);
    CHECK(stated < 2 * scatter);
  }
}
