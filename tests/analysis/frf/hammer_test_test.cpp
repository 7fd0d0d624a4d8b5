#include "analysis/frf/hammer_test.hpp"

#include <catch2/catch.hpp>

#include "tests/analysis/frf/two_masses.hpp"

using namespace rvbench;
using namespace rvbench::analysis;

namespace {

const test::TwoMasses body;
constexpr HitLimits band{.from_Hz = 5, .to_Hz = 100};

double largest_error(const FrequencyResponse& frf, int to, double decay_s) {
  double largest = 0, peak = 0;
  for (double f_Hz = band.from_Hz; f_Hz <= band.to_Hz; f_Hz += frf.step_Hz) {
    const auto k = Eigen::Index(std::lround(f_Hz / frf.step_Hz));
    const auto truth = body.accelerance(test::j_omega(frf.frequency_Hz(k)) + 1 / decay_s, to, 0);
    largest = std::max(largest, std::abs(frf.values[k] - truth));
    peak = std::max(peak, std::abs(truth));
  }
  return largest / peak;
}

}  // namespace

SCENARIO("a session of hits becomes frequency responses", "[analysis][frf]") {
  GIVEN("four good hits of different force, a double one, a weak one and a late one") {
    HammerSeries series{test::hammer_on_left(), {}};
    for (const double peak_N : {80.0, 100.0, 130.0, 110.0}) {
      series.hits.push_back(test::hit_on(body, {.peak_N = peak_N}));
    }
    FrfRecord twice = test::hit_on(body);
    twice.excitations.col(0) += 0.5 * twice.excitations.col(0).reverse();
    series.hits.push_back(twice);
    series.hits.push_back(test::hit_on(body, {.peak_N = 10}));
    series.hits.push_back(test::hit_on(body, {.rate_Hz = 2048}));
    const HammerResult result = measure_session({series}, {.limits = band}).front();
    THEN("the good ones are accepted, the others with their reason not") {
      REQUIRE(result.hits.size() == 7);
      for (std::size_t i = 0; i < 4; ++i) CHECK(result.hits[i].accepted());
      CHECK(result.hits[4].faults.at(0).kind == HitFaultKind::double_hit);
      CHECK(result.hits[5].faults.at(0).kind == HitFaultKind::weak);
      CHECK(result.hits[6].faults.at(0).kind == HitFaultKind::unequal);
    }
    THEN("the responses are those of the closed form, place by place") {
      REQUIRE(result.estimates.responses.size() == 2);
      for (int to = 0; to < 2; ++to) {
        const FrequencyResponse& frf = result.estimates.responses[std::size_t(to)].response;
        CHECK(largest_error(frf, to, 1e300) < 1e-9);  // exact but for the window's feet
        CHECK(frf.response.point == (to == 0 ? "left" : "right"));
        CHECK(frf.excitation.point == "left");
        CHECK(frf.response_unit == "m/s²");
        CHECK(frf.averages == 4);
        CHECK(frf.coherence.segment(40, 700).minCoeff() > 1 - 1e-9);
      }
    }
  }
  GIVEN("one place where no hit is good") {
    HammerSeries series{test::hammer_on_left(), {test::hit_on(body)}};
    series.hits[0].excitations.setZero();
    THEN("there is no response, rather than one of nothing") {
      CHECK(measure_session({series}, {}).front().estimates.responses.empty());
    }
  }
}

SCENARIO("an exponential window adds damping and nothing else", "[analysis][frf]") {
  constexpr double decay_s = 0.2;
  const HammerSeries series{test::hammer_on_left(), {test::hit_on(body)}};
  const HammerOptions options{.windows = {.decay_s = decay_s}, .limits = band};
  const HammerResult result = measure_session({series}, options).front();
  REQUIRE(result.estimates.responses.size() == 2);
  THEN("the response is the true one at jω + 1/decay, on every line") {
    for (int to = 0; to < 2; ++to) {
      CHECK(largest_error(result.estimates.responses[std::size_t(to)].response, to, decay_s) <
            1e-6);
    }
  }
  THEN("a note tells what is in it; of a single hit there is neither coherence nor error") {
    const EstimatedResponse& pair = result.estimates.responses[0];
    REQUIRE(pair.response.notes.size() == 1);
    CHECK(pair.response.notes[0] ==
          "exponential window of 0.2 s: adds 5 rad/s to each mode's decay");
    CHECK(pair.response.coherence.size() == 0);
    CHECK(pair.standard_error.array().isNaN().all());
  }
}

TEST_CASE("the window's damping is taken out of a mode exactly", "[analysis][frf]") {
  const double omega = units::two_pi * 40, decay_s = 0.2;
  const double sigma = 0.01 * omega + 1 / decay_s;
  const double damped = omega * std::sqrt(1 - 1e-4);
  const double seen = std::hypot(sigma, damped);
  CHECK(damping_without_window(sigma / seen, seen / units::two_pi, decay_s) ==
        Approx(0.01).epsilon(1e-12));
  CHECK(damping_without_window(0.03, 40, 1e300) == Approx(0.03));
  CHECK(damping_without_window(0.001, 40, decay_s) < 0);
}

TEST_CASE("the force window keeps the pulse and drops the rest", "[analysis][frf]") {
  ForcePulse pulse;
  pulse.first = 100;
  pulse.peak = 105;
  pulse.last = 109;
  const Eigen::VectorXd window = force_window(pulse, 400, 2);
  CHECK(window.segment(80, 50).isOnes());
  CHECK(window.head(70).isZero());
  CHECK(window.tail(400 - 140).isZero());
  CHECK(window[134] == Approx(0.5));  // half a cosine of ten samples from 129 on
  CHECK_THROWS_AS(force_window(pulse, 400, 0), std::invalid_argument);
}
