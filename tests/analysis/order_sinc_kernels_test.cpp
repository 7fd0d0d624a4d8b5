#include <catch2/catch.hpp>

#include "analysis/order/sinc_kernels.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;

TEST_CASE("every processor weighs samples alike", "[analysis][order][law]") {
  const Eigen::VectorXd x = test::white_noise(67, 1);
  const Eigen::VectorXd below = test::white_noise(66, 2), above = test::white_noise(66, 3);
  const double weight = 0.3;
  for (const Eigen::Index taps : {4, 6, 8, 14, 32, 66}) {
    const auto samples = x.segment(1, taps);  // where no vector is aligned
    const double expected =
        (1 - weight) * samples.dot(below.head(taps)) + weight * samples.dot(above.head(taps));
    for (const auto* kernels : {&analysis::sinc_kernels(), &analysis::portable_sinc_kernels()}) {
      CHECK(kernels->between(samples.data(), below.data(), above.data(), weight, taps) ==
            Approx(expected).epsilon(1e-12));
    }
  }
}
