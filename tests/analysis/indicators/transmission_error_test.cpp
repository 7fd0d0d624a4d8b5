#include "analysis/indicators/transmission_error.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/signals.hpp"

using rvbench::analysis::transmission_error;
using rvbench::test::tone;

namespace {

// 1000 samples per output turn; a ratio of 50; angles in turns.
Eigen::VectorXd output_turns(Eigen::Index n) { return rvbench::test::times_s(n, 1000); }

}  // namespace

TEST_CASE("an output that swings by a has a transmission error of 2a", "[analysis][indicators]") {
  const double order = GENERATE(1, 2, 39);
  const Eigen::Index n = GENERATE(1001, 4321);  // the rest of a turn is left out
  const Eigen::VectorXd even = output_turns(n);
  const auto error = transmission_error(50 * even, even + 1e-4 * tone(order, n, 1000, 0.7), 1);
  REQUIRE(error);
  CHECK(*error == Approx(2e-4).epsilon(0.01));
}

TEST_CASE("a ratio that is off its nominal one, and the way round, are no error",
          "[analysis][indicators]") {
  const Eigen::VectorXd even = output_turns(2500);
  CHECK(*transmission_error(49.7 * even, even, 1) < 1e-12);
  CHECK(*transmission_error(50 * even, -even, 1) < 1e-12);
  CHECK(*transmission_error(50 * even.array() + 3, even.array() - 8, 1) < 1e-12);
}

TEST_CASE("less than a turn of the output has none", "[analysis][indicators]") {
  const Eigen::VectorXd even = output_turns(990);
  CHECK_FALSE(transmission_error(50 * even, even, 1));
  CHECK_FALSE(transmission_error(Eigen::VectorXd::Zero(2500), output_turns(2500), 1));
  CHECK_THROWS_AS(transmission_error(even, even.head(5), 1), std::invalid_argument);
  CHECK_THROWS_AS(transmission_error(even, even, 0), std::invalid_argument);
}
