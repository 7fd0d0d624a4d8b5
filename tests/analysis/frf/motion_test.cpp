#include "analysis/frf/motion.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/analysis/frf/two_masses.hpp"

using namespace rvbench;
using namespace rvbench::analysis;

TEST_CASE("receptance, mobility and accelerance are one response", "[analysis][frf]") {
  const test::TwoMasses body;
  const FrequencyResponse accelerance = test::accelerance_of(body, 1, 0, 0.5, 200);
  const auto receptance = as_motion(accelerance, Motion::displacement);
  const auto mobility = as_motion(accelerance, Motion::velocity);
  REQUIRE((receptance && mobility));
  CHECK(receptance->response_unit == "m");
  CHECK(mobility->response_unit == "m/s");
  for (Eigen::Index k = 1; k < 200; ++k) {
    const auto s = test::j_omega(0.5 * double(k));
    const auto truth = body.receptance_m_N(s, 1, 0);
    CHECK(std::abs(receptance->values[k] - truth) < 1e-12 * std::abs(truth));
    CHECK(std::abs(mobility->values[k] - s * truth) < 1e-12 * std::abs(s * truth));
  }
  const auto back = as_motion(*receptance, Motion::acceleration);
  CHECK((back->values - accelerance.values).tail(199).norm() < 1e-12);
}

TEST_CASE("what an integral is at 0 Hz is not known, and said", "[analysis][frf]") {
  FrequencyResponse frf = test::accelerance_of({}, 0, 0, 1, 10);
  const auto mobility = as_motion(frf, Motion::velocity);
  CHECK(std::isnan(mobility->values[0].real()));
  REQUIRE(mobility->notes.size() == 1);
  CHECK(mobility->notes[0] == "not known at 0 Hz: an integral of m/s²");
  frf.response_unit = "m";
  CHECK(as_motion(frf, Motion::acceleration)->values[0] == 0.0);  // what rests is not accelerated
  CHECK(as_motion(frf, Motion::displacement)->values == frf.values);
  frf.first_Hz = 1;
  CHECK(as_motion(frf, Motion::acceleration)->values.allFinite());
}

TEST_CASE("a response that is no motion is not converted", "[analysis][frf]") {
  FrequencyResponse frf = test::accelerance_of({}, 0, 0, 1, 10);
  for (const char* unit : {"", "Pa", "g"}) {
    frf.response_unit = unit;
    CHECK_FALSE(as_motion(frf, Motion::velocity));
  }
  frf.response_unit = "rad/s²";
  CHECK(as_motion(frf, Motion::velocity)->response_unit == "rad/s");
}

TEST_CASE("an error is converted like its response", "[analysis][frf]") {
  EstimatedResponse estimate;
  estimate.response = test::accelerance_of({}, 0, 0, 1, 10);
  estimate.standard_error = estimate.response.values.cwiseAbs() / 10;
  const auto mobility = as_motion(estimate, Motion::velocity);
  REQUIRE(mobility);
  CHECK(
      mobility->standard_error.tail(9).isApprox(mobility->response.values.cwiseAbs().tail(9) / 10));
}
