#include <catch2/catch.hpp>
#include <limits>

#include "analysis/order/resolution.hpp"
#include "analysis/spectrum.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::are_parted;
using analysis::is_placed;
using analysis::turns_to_part;

TEST_CASE("the sun against the carrier is parted from the shaft by four output turns",
          "[analysis][order]") {
  CHECK(turns_to_part(120.0 / 121, 1) == Approx(4 * 121));
  CHECK(are_parted(120.0 / 121, 1, 4 * 121));
  CHECK_FALSE(are_parted(120.0 / 121, 1, 3.9 * 121));
  CHECK(are_parted(1, 120.0 / 121, 4 * 121));
}

TEST_CASE("what the speed leaves open, no length of record parts", "[analysis][order]") {
  CHECK(are_parted(30, 30.1, 1000));
  CHECK_FALSE(are_parted(30, 30.1, 1000, 2e-3));
  CHECK_FALSE(are_parted(30, 30.1, 1e9, 2e-3));
}

TEST_CASE("an order is not parted from itself", "[analysis][order]") {
  CHECK_FALSE(are_parted(2, 2, 1e9));
  CHECK_THROWS_AS(turns_to_part(2, 2), std::invalid_argument);
  CHECK_THROWS_AS(turns_to_part(2, std::numeric_limits<double>::infinity()), std::invalid_argument);
  CHECK_THROWS_AS(are_parted(1, 2, -1), std::invalid_argument);
}

TEST_CASE("a stated speed places low orders of short records, a measured angle all",
          "[analysis][order]") {
  CHECK(is_placed(1000, 1e5, 0));
  CHECK(is_placed(1, 330, 3e-4));
  CHECK_FALSE(is_placed(1, 340, 3e-4));
  CHECK_FALSE(is_placed(1080.0 / 121, 484, 3e-4));  // 1.3 lines
}

TEST_CASE("two tones that are parted each read their own amplitude", "[analysis][order][law]") {
  // Four lines apart neither tone reaches the other's highest line, whatever their phases; two
  // lines apart it does.
  const double phase_rad = GENERATE(0.0, 1.0, 2.0, 3.0);
  const auto read = [&](double apart_Hz) {
    const Eigen::VectorXd x =
        test::tone(20, 1000, 100) + test::tone(20 + apart_Hz, 1000, 100, phase_rad);
    return analysis::amplitude_spectrum(x, 100, analysis::Window::hann).amplitude[200];
  };
  REQUIRE(are_parted(20, 20.4, 10));
  CHECK(read(0.4) == Approx(1).epsilon(1e-9));
  REQUIRE_FALSE(are_parted(20, 20.1, 10));
  CHECK(std::abs(read(0.1) - 1) > 0.1);
}
