#include "analysis/frf/find_modes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/frf/mode_indicator.hpp"
#include "tests/analysis/frf/two_masses.hpp"
#include "tests/support/under_sanitizer.hpp"

using namespace rvbench;
using namespace rvbench::analysis;

namespace {

constexpr double step_Hz = 0.25;
constexpr Eigen::Index lines = 512;
const test::TwoMasses body;

std::vector<FrequencyResponse> responses_of(const test::TwoMasses& masses) {
  return {test::accelerance_of(masses, 0, 0, step_Hz, lines),
          test::accelerance_of(masses, 1, 0, step_Hz, lines)};
}

Eigen::VectorXcd complex_noise(Eigen::Index n, unsigned seed) {
  Eigen::VectorXcd noise(n);
  noise.real() = test::white_noise(n, 2 * seed);
  noise.imag() = test::white_noise(n, 2 * seed + 1);
  return noise;
}

}  // namespace

SCENARIO("two coupled masses have the two modes of the closed form", "[analysis][frf]") {
  GIVEN("their accelerances, without noise") {
    const auto modes = find_modes(responses_of(body), {});
    THEN("frequencies are right to 0.01 %, damping to 1 %, and none is doubted") {
      REQUIRE(modes.size() == 2);
      CHECK(modes[0].frequency_Hz == Approx(40).epsilon(1e-4));
      CHECK(modes[1].frequency_Hz == Approx(65).epsilon(1e-4));
      CHECK(modes[0].damping_ratio == Approx(0.01).epsilon(0.01));
      CHECK(modes[1].damping_ratio == Approx(0.02).epsilon(0.01));
      CHECK((modes[0].sure() && modes[1].sure()));
    }
    THEN("the masses move together in the first and against each other in the second") {
      CHECK((modes[0].residues[1] / modes[0].residues[0]).real() == Approx(1).epsilon(0.02));
      CHECK((modes[1].residues[1] / modes[1].residues[0]).real() == Approx(-1).epsilon(0.02));
    }
  }
  GIVEN("one response of no stated unit") {
    auto one = responses_of(body);
    one.pop_back();
    one[0].response_unit.clear();
    THEN("it is enough, near enough") {
      const auto modes = find_modes(one, {});
      REQUIRE(modes.size() == 2);
      CHECK(modes[1].frequency_Hz == Approx(65).epsilon(1e-3));
    }
  }
  GIVEN("a span of 50 Hz, and a search up to 60 Hz") {
    THEN("the second is told to lie above the span, or not looked for") {
      const auto modes = find_modes(responses_of(body), {.span_Hz = 50});
      REQUIRE(modes.size() == 2);
      CHECK(modes[0].sure());
      REQUIRE(modes[1].doubts.size() == 1);
      CHECK(modes[1].doubts[0] == "above the span of 50 Hz");
      CHECK(find_modes(responses_of(body), {.to_Hz = 60}).size() == 1);
    }
  }
  GIVEN("an exponential window of 0.5 s in them") {
    std::vector<FrequencyResponse> windowed = responses_of(body);
    for (int to = 0; to < 2; ++to) {
      FrequencyResponse& frf = windowed[std::size_t(to)];
      for (Eigen::Index k = 0; k < lines; ++k) {
        frf.values[k] = body.accelerance(test::j_omega(frf.frequency_Hz(k)) + 2.0, to, 0);
      }
    }
    THEN("its damping is in the modes, until it is told") {
      const double seen = 0.01 + 2 / (units::two_pi * 40);
      CHECK(find_modes(windowed, {}).at(0).damping_ratio == Approx(seen).epsilon(0.01));
      const auto modes = find_modes(windowed, {.decay_s = 0.5});
      REQUIRE(modes.size() == 2);
      CHECK(modes[0].damping_ratio == Approx(0.01).epsilon(0.01));
      CHECK(modes[1].damping_ratio == Approx(0.02).epsilon(0.01));
      CHECK(modes[0].frequency_Hz == Approx(40).epsilon(1e-4));
    }
  }
}

TEST_CASE("two modes within a line are parted by two excitations", "[analysis][frf]") {
  const test::TwoMasses close{.first_Hz = 60, .second_Hz = 60.2, .second_damping = 0.012};
  std::vector<FrequencyResponse> all = responses_of(close);
  CHECK(find_modes(all, {}).size() == 1);  // of one excitation, as the limits say
  all.push_back(test::accelerance_of(close, 0, 1, step_Hz, lines));
  all.push_back(test::accelerance_of(close, 1, 1, step_Hz, lines));
  const auto modes = find_modes(all, {});
  REQUIRE(modes.size() == 2);
  CHECK(modes[0].frequency_Hz == Approx(60).epsilon(1e-4));
  CHECK(modes[1].frequency_Hz == Approx(60.2).epsilon(1e-4));
  CHECK(modes[0].damping_ratio == Approx(0.01).epsilon(0.01));
  CHECK(modes[1].damping_ratio == Approx(0.012).epsilon(0.01));
}

// 100 draws: the root mean square of standardised errors is known within 10 % or so, for three
// standard deviations.
TEST_CASE("a mode's errors are what repetition shows, and bias is none", "[analysis][frf]") {
  const auto clean = responses_of(body);
  double squares = 0, damping_squares = 0, sum = 0;
  constexpr int draws = 100;
  for (unsigned seed = 1; seed <= draws; ++seed) {
    auto noisy = clean;
    for (std::size_t i = 0; i < 2; ++i) {  // equal noise of the mobilities that are fitted
      const Eigen::VectorXcd noise = complex_noise(lines, 2 * seed + unsigned(i));
      for (Eigen::Index k = 0; k < lines; ++k) {
        noisy[i].values[k] += 2e-4 * std::abs(test::j_omega(step_Hz * double(k))) * noise[k];
      }
    }
    const auto modes = find_modes(noisy, {.from_Hz = 60, .to_Hz = 70});
    REQUIRE(modes.size() == 1);
    const double error = (modes[0].frequency_Hz - 65) / modes[0].frequency_error_Hz;
    const double damping_error = (modes[0].damping_ratio - 0.02) / modes[0].damping_error;
    squares += error * error / draws;
    damping_squares += damping_error * damping_error / draws;
    sum += damping_error / draws;
  }
  CHECK(std::sqrt(squares) == Approx(1).margin(0.25));
  CHECK(std::sqrt(damping_squares) == Approx(1).margin(0.25));
  CHECK(std::abs(sum) < 0.35);  // noise does not widen a resonance: the mean of 100 is 0 ± 0.1
}

TEST_CASE("noise alone has no mode", "[analysis][frf][null]") {
  const auto places = GENERATE(1, 6);
  const unsigned searches = test::under_sanitizer ? 1 : 10;
  const Eigen::Index count = test::under_sanitizer ? 256 : 1024;
  int found = 0;
  for (unsigned seed = 1; seed <= searches; ++seed) {
    std::vector<FrequencyResponse> noise;
    for (int i = 0; i < places; ++i) {
      FrequencyResponse frf = test::accelerance_of(body, 0, 0, step_Hz, count);
      frf.response.point = std::to_string(i);
      frf.response_unit.clear();  // not weighted over frequency
      frf.values = complex_noise(count, 100 * seed + unsigned(i));
      noise.push_back(std::move(frf));
    }
    found += int(find_modes(noise, {}).size());
  }
  CAPTURE(places);
  CHECK(found == 0);
}

TEST_CASE("a free mass and a spring have no mode", "[analysis][frf][null]") {
  FrequencyResponse mass = test::accelerance_of(body, 0, 0, step_Hz, lines);
  mass.values = Eigen::VectorXcd::Ones(lines) / 2.0 + 1e-3 * complex_noise(lines, 1);
  CHECK(find_modes({mass}, {}).empty());
  FrequencyResponse spring = mass;
  spring.response_unit = "m";
  spring.values = Eigen::VectorXcd::Constant(lines, 1e-6) + 1e-9 * complex_noise(lines, 2);
  CHECK(find_modes({spring}, {}).empty());
}

TEST_CASE("the mode indicator is the singular values of the matrix", "[analysis][frf]") {
  std::vector<FrequencyResponse> all;
  for (int to = 0; to < 2; ++to) {
    for (int at = 0; at < 2; ++at) {
      all.push_back(test::accelerance_of(body, to, at, step_Hz, lines));
    }
  }
  const Eigen::MatrixXd indicator = mode_indicator(all);
  REQUIRE(indicator.cols() == 2);
  for (Eigen::Index k = 1; k < lines; ++k) {
    // A symmetric matrix (a b; b a) has the singular values |a + b| and |a - b|.
    const double together = std::abs(all[0].values[k] + all[1].values[k]);
    const double against = std::abs(all[0].values[k] - all[1].values[k]);
    CHECK(indicator(k, 0) == Approx(std::max(together, against)));
    CHECK(indicator(k, 1) == Approx(std::min(together, against)));
  }
  all.pop_back();  // a hole in the grid: one column
  CHECK(mode_indicator(all).cols() == 1);
  CHECK(mode_indicator(all)(100, 0) ==
        Approx(std::sqrt(std::norm(all[0].values[100]) + 2 * std::norm(all[1].values[100]))));
  all[1].values[7] = std::nan("");
  CHECK(std::isnan(mode_indicator(all)(7, 0)));
  all[1].step_Hz = 1;
  CHECK_THROWS_AS(mode_indicator(all), std::invalid_argument);
  CHECK_THROWS_AS(find_modes({}, {}), std::invalid_argument);
}
