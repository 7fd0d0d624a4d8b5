#include "analysis/frf/hit_deviations.hpp"

#include <catch2/catch.hpp>

using namespace rvbench;
using namespace rvbench::analysis;
using Eigen::Index;

namespace {

constexpr double rate_Hz = 64;

// A structure that answers at once: an impulse of this size, and so many times it at two sensors.
FrfRecord hit(double force, double gain, double second_gain) {
  FrfRecord record{"hit", rate_Hz, Eigen::VectorXd::Zero(64), Eigen::MatrixXd::Zero(64, 2)};
  record.excitations(5, 0) = force;
  record.responses(5, 0) = gain * force;
  record.responses(5, 1) = second_gain * force;
  return record;
}

}  // namespace

TEST_CASE("a hit deviates from the average by as much as it weighs there", "[frf]") {
  // H1 weighs by power: (1·1 + 3·4)/5 = 2.6, so (1 - 2.6)·1/2.5 and (3 - 2.6)·4/2.5.
  const auto found = hit_deviations({hit(1, 1, 7), hit(2, 3, 7)}, {4, 20});
  REQUIRE(found.size() == 2);
  REQUIRE(found[0].rows() == 2);
  REQUIRE(found[0].cols() == 17);
  for (Index line = 0; line < 17; ++line) {
    CHECK(std::abs(found[0](0, line) - std::complex<float>(-0.64f)) < 1e-5);
    CHECK(std::abs(found[1](0, line) - std::complex<float>(0.64f)) < 1e-5);
    CHECK(std::abs(found[0](1, line)) < 1e-5);
  }
}

TEST_CASE("hits that are alike do not deviate, nor does silence", "[frf][null]") {
  for (const auto& deviations : hit_deviations({hit(1, 2, 3), hit(5, 2, 3)}, {1, 30})) {
    CHECK(deviations.cwiseAbs().maxCoeff() < 1e-5);
  }
  CHECK(hit_deviations({hit(0, 1, 1), hit(0, 1, 1)}, {1, 30})[0].isZero());
}

TEST_CASE("deviations are refused hits that do not belong together, and bands beyond the lines",
          "[frf]") {
  CHECK_THROWS_AS(hit_deviations({hit(1, 1, 1)}, {4, 40}), std::invalid_argument);
  CHECK_THROWS_AS(hit_deviations({}, {4, 20}), std::invalid_argument);
  FrfRecord longer = hit(1, 1, 1);
  longer.excitations.conservativeResize(70, 1);
  CHECK_THROWS_AS(hit_deviations({hit(1, 1, 1), longer}, {4, 20}), std::invalid_argument);
}

TEST_CASE("lines of a band are those within it, ends included", "[frf]") {
  CHECK(lines_of({5, 500}, 0, 0.25).first == 20);
  CHECK(lines_of({5, 500}, 0, 0.25).count == 1981);
  CHECK(lines_of({5, 500}, 5, 0.25).first == 0);
  CHECK(lines_of({0.3, 0.9}, 0, 0.1).count == 7);  // 0.3/0.1 is a little less than 3
  CHECK(lines_of({5.1, 5.2}, 0, 0.25).count <= 0);
}
