#include "analysis/frf/unlike_hits.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "analysis/frf/hammer_test.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using Catch::Matchers::Contains;
using Eigen::Index;

namespace {

constexpr Index samples = 1024, pulse_at = 64, answers = 3;

/// What three sensors answer to an impulse along one axis: rings that die out within the record.
Eigen::MatrixXd answer_to(int axis) {
  std::mt19937 generator{unsigned(axis)};
  std::normal_distribution<double> gaussian;
  Eigen::MatrixXd rings(samples, answers);
  for (Index sensor = 0; sensor < answers; ++sensor) {
    for (Index i = 0; i < samples; ++i) {
      rings(i, sensor) = gaussian(generator) * std::exp(-double(i) / 60);
    }
  }
  return rings;
}

/// A half sine of ten samples, so far off its axis towards another, as a load cell with so much
/// gain tells it.
FrfRecord hit(double angle_rad, double gain = 1) {
  const Eigen::MatrixXd answer =
      std::cos(angle_rad) * answer_to(1) + std::sin(angle_rad) * answer_to(2);
  FrfRecord record{"made", 1000, Eigen::MatrixXd::Zero(samples, 1),
                   Eigen::MatrixXd::Zero(samples, answers)};
  for (Index i = 1; i < 10; ++i) {
    const double force = 100 * std::sin(0.1 * double(i) * 3.14159265358979);
    record.excitations(pulse_at + i, 0) = force / gain;
    record.responses.bottomRows(samples - pulse_at - i) +=
        force * answer.topRows(samples - pulse_at - i);
  }
  return record;
}

HammerResult measured(const std::vector<FrfRecord>& hits) {
  const FrfSetup setup{{{{"here", "+X"}, "N"}},
                       {{{"a", "+X"}, "m/s²"}, {{"b", "+X"}, "m/s²"}, {{"c", "+X"}, "m/s²"}}};
  return measure_session({{setup, hits}}, {})[0];
}

}  // namespace

TEST_CASE("hits that differ in gain lie as far apart as their gains", "[analysis][frf]") {
  const Eigen::VectorXd apart = distances_to_others({hit(0), hit(0, 1.05), hit(0)});
  CHECK(apart[0] == Approx(0).margin(1e-9));
  CHECK(apart[1] == Approx(0.05 / std::sqrt(1.05)).epsilon(1e-6));
  CHECK(apart[2] == Approx(0).margin(1e-9));
}

TEST_CASE("a hit off its axis lies off by the chord of the angle", "[analysis][frf]") {
  for (const double angle_rad : {0.02, 0.2, 0.8}) {
    const double apart = distances_to_others({hit(0), hit(0), hit(angle_rad), hit(0)})[2];
    // Answers to two axes are alike in size and share nothing, but for what chance gives them.
    CHECK(apart == Approx(2 * std::sin(angle_rad / 2)).epsilon(0.25));
  }
}

TEST_CASE("a session does without hits that are off, and says so", "[analysis][frf]") {
  const HammerResult result =
      measured({hit(0, 1.03), hit(0.7), hit(0.02, 0.98), hit(-0.8), hit(-0.02)});
  for (const std::size_t good : {0u, 2u, 4u}) CHECK(result.hits[good].accepted());
  for (const std::size_t bad : {1u, 3u}) {
    REQUIRE(result.hits[bad].faults.size() == 1);
    CHECK(result.hits[bad].faults[0].kind == HitFaultKind::unlike_others);
    CHECK_THAT(result.hits[bad].faults[0].reason, Contains("off in direction or place"));
  }
  CHECK(result.estimates.responses[0].response.averages == 3);
}

TEST_CASE("hits as people make them are all used", "[analysis][frf][null]") {
  const HammerResult result =
      measured({hit(0.02, 1.05), hit(-0.03, 0.96), hit(0.01, 1.02), hit(0.04, 0.95)});
  for (const JudgedHit& judged : result.hits) CHECK(judged.accepted());
}

TEST_CASE("of two hits that differ none is known to be the odd one", "[analysis][frf]") {
  CHECK(distances_to_others({hit(0), hit(0.8)}).norm() == 0);
  CHECK(distances_to_others({}).size() == 0);
  FrfRecord other = hit(0);
  other.responses.conservativeResize(samples, 2);
  CHECK_THROWS_AS(distances_to_others({hit(0), hit(0), other}), std::invalid_argument);
}
