#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/order/line_phase.hpp"
#include "analysis/order/line_ridge.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::angle_of_line;
using analysis::line_phase;
using analysis::line_ridge;
using analysis::RidgeSearch;

namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double rate_Hz = 4000;
constexpr Eigen::Index count = 80000;  // 20 s
constexpr double teeth = 23;
constexpr RidgeSearch around_mesh{
    .from_Hz = 350, .to_Hz = 600, .block_s = 1, .most_change_Hz_s = 20};

// Turns of a shaft that runs up from 18 rev/s by 0.1 rev/s², with 0.1 % ripple at 2 Hz.
Eigen::ArrayXd turns_at(const Eigen::ArrayXd& t) {
  return 18 * t + 0.05 * t.square() + 0.018 / (two_pi * 2) * (two_pi * 2 * t).sin();
}
double speed_Hz_at(double t) { return 18 + 0.1 * t + 0.018 * std::cos(two_pi * 2 * t); }

// Its mesh line, and the second harmonic beside.
Eigen::VectorXd mesh(double amplitude = 1) {
  const Eigen::ArrayXd turns = turns_at(test::times_s(count, rate_Hz));
  return amplitude * (two_pi * teeth * turns + 0.7).cos() +
         amplitude * (two_pi * 2 * teeth * turns).sin();
}

}  // namespace

TEST_CASE("a ridge follows a line through a run-up", "[analysis][order]") {
  const auto ridge = line_ridge(mesh() + 0.5 * test::white_noise(count, 1), rate_Hz, around_mesh);
  REQUIRE(ridge);
  CHECK(ridge->p_value < 1e-12);
  REQUIRE(ridge->frequency_Hz.size() == 39);
  for (Eigen::Index b = 0; b < ridge->frequency_Hz.size(); ++b) {
    const double t = ridge->start_s + double(b) * ridge->step_s;
    const double mean_Hz = teeth * (18 + 0.1 * t);
    CHECK(ridge->frequency_Hz[b] == Approx(mean_Hz).margin(teeth * 0.018 + 0.1));
  }
}

TEST_CASE("a line that others outshine for a while keeps its ridge", "[analysis][order]") {
  // For 2 s of 20 a tone ten times as strong sounds 100 Hz above: too far to jump to.
  Eigen::VectorXd x = mesh() + 0.2 * test::white_noise(count, 2);
  x.segment(30000, 8000) += 10 * test::tone(540, 8000, rate_Hz);
  const auto ridge = line_ridge(x, rate_Hz, around_mesh);
  REQUIRE(ridge);
  CHECK(ridge->frequency_Hz[18] == Approx(teeth * 18.95).margin(1.5));
}

TEST_CASE("noise alone has no ridge", "[analysis][order][null]") {
  int found = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    found += line_ridge(test::white_noise(16000, seed), rate_Hz, around_mesh).has_value();
  }
  CHECK(found == 0);  // one in 1000 at the most
  CHECK_FALSE(line_ridge(Eigen::VectorXd::Zero(count), rate_Hz, around_mesh));
}

TEST_CASE("the phase of a line is the angle of its shaft", "[analysis][order][law]") {
  const auto ridge = line_ridge(mesh(), rate_Hz, around_mesh);
  REQUIRE(ridge);
  const auto line = line_phase(mesh(), rate_Hz, *ridge, 20);
  REQUIRE(line);
  CHECK(line->faded == 0);
  const auto shaft = angle_of_line(*line, 0, teeth);
  REQUIRE(shaft);
  // 80 dB leave an error of 1e-4 of the amplitude at the most, in radians of the line.
  const Eigen::Index ends = 2 * line->settling;
  const Eigen::ArrayXd t = test::times_s(count, rate_Hz);
  const Eigen::ArrayXd true_cycles = teeth * turns_at(t);
  const Eigen::ArrayXd off = line->cycles.array() - true_cycles;
  const Eigen::ArrayXd inner = off.segment(ends, count - 2 * ends);
  CHECK(inner.maxCoeff() - inner.minCoeff() < 2 * 1e-4);
  CHECK(line->amplitude.segment(ends, count - 2 * ends).minCoeff() == Approx(1).margin(1e-3));
  CHECK(line->amplitude.segment(ends, count - 2 * ends).maxCoeff() == Approx(1).margin(1e-3));
  // And so the speed, within the ripple, too.
  for (double at = 3; at < 17; at += 0.0501) {
    const double speed_Hz = (shaft->turns_at(at + 0.01) - shaft->turns_at(at - 0.01)) / 0.02;
    CHECK(speed_Hz == Approx(speed_Hz_at(at)).epsilon(5e-5));
  }
}

TEST_CASE("the error of the phase is what the noise makes it", "[analysis][order][law]") {
  double made = 0, stated = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Eigen::VectorXd x = mesh() + 2 * test::white_noise(count, seed);
    const auto ridge = line_ridge(x, rate_Hz, around_mesh);
    REQUIRE(ridge);
    const auto line = line_phase(x, rate_Hz, *ridge, 20);
    REQUIRE(line);
    const Eigen::Index ends = 2 * line->settling;
    const Eigen::ArrayXd off =
        (line->cycles.array() - teeth * turns_at(test::times_s(count, rate_Hz)))
            .segment(ends, count - 2 * ends);
    made += (off - off.mean()).square().mean() / 8;
    stated += std::pow(line->standard_error_cycles, 2) / 8;
  }
  CHECK(std::sqrt(stated) == Approx(std::sqrt(made)).epsilon(0.1));
}

TEST_CASE("without a rate all is in cycles per sample", "[analysis][order]") {
  const RidgeSearch per_sample{350 / rate_Hz, 600 / rate_Hz, 4000, 20 / (rate_Hz * rate_Hz)};
  const auto ridge = line_ridge(mesh(), 1, per_sample);
  REQUIRE(ridge);
  const auto line = line_phase(mesh(), 1, *ridge, 20 / rate_Hz);
  REQUIRE(line);
  const auto known = line_phase(mesh(), rate_Hz, *line_ridge(mesh(), rate_Hz, around_mesh), 20);
  CHECK(line->mean_frequency_Hz() * rate_Hz == Approx(known->mean_frequency_Hz()).epsilon(1e-9));
}

TEST_CASE("constant speed is told as constant", "[analysis][order]") {
  const Eigen::VectorXd x = test::tone(teeth * 20.123, count, rate_Hz);
  const auto line = line_phase(x, rate_Hz, *line_ridge(x, rate_Hz, around_mesh), 20);
  REQUIRE(line);
  CHECK(line->mean_frequency_Hz() == Approx(teeth * 20.123).epsilon(1e-8));
}

TEST_CASE("a line that noise hides has no phase", "[analysis][order][null]") {
  const Eigen::VectorXd x = 0.1 * mesh() + 2 * test::white_noise(count, 3);
  const analysis::LineRidge told{0.5, 0.5, Eigen::VectorXd::Constant(39, teeth * 19), 0};
  CHECK_FALSE(line_phase(x, rate_Hz, told, 60));
}

TEST_CASE("what cannot be followed is refused", "[analysis][order]") {
  const Eigen::VectorXd x = mesh();
  CHECK_THROWS_AS(line_ridge(x, rate_Hz, {600, 350, 1, 1}), std::invalid_argument);
  CHECK_THROWS_AS(line_ridge(x, rate_Hz, {350, 2001, 1, 1}), std::invalid_argument);
  CHECK_THROWS_AS(line_ridge(x, rate_Hz, {350, 360, 1, 1}), std::invalid_argument);
  CHECK_THROWS_AS(line_ridge(x, rate_Hz, {350, 600, 0.005, 1}), std::invalid_argument);
  const analysis::LineRidge ridge{0.5, 0.5, Eigen::VectorXd::Constant(39, 440), 0};
  CHECK_THROWS_AS(line_phase(x, rate_Hz, ridge, 0), std::invalid_argument);
  CHECK_THROWS_AS(line_phase(x, rate_Hz, ridge, 200), std::invalid_argument);
  CHECK_THROWS_AS(line_phase(x, rate_Hz, ridge, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(line_phase(x, rate_Hz, {}, 20), std::invalid_argument);
  CHECK_THROWS_AS(angle_of_line({}, 0, 0), std::invalid_argument);
}
