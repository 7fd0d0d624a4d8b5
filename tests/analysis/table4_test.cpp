#include "analysis/table4.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace rvbench::analysis {

TEST_CASE("the published meshing row fits a motor below nominal speed, the pin row does not",
          "[analysis][literature]") {
  const auto& mesh = table4()[1];
  const auto& pin = table4()[3];
  const double slip_pct[] = {3.0, 2.5, 2.3};
  for (std::size_t i = 0; i < 3; ++i) {
    const double shaft_Hz = table4_speeds_rpm[i] / 60;
    CHECK(100 * (1 - mesh.frequency_Hz[i] / (1080.0 / 121 * shaft_Hz)) ==
          Approx(slip_pct[i]).margin(0.1));
    CHECK(pin.frequency_Hz[i] == Approx(78.0 / 121 * shaft_Hz).margin(0.05));
  }
}

TEST_CASE("the published catalogue has the same rows at every speed", "[analysis]") {
  const Kinematics slow = published_table4(598);
  const Kinematics fast = published_table4(1790);
  CHECK(slow.orders.size() == 7);
  REQUIRE(slow.signatures.size() == fast.signatures.size());
  for (std::size_t i = 0; i < slow.signatures.size(); ++i) {
    CHECK(slow.signatures[i].table4_item == fast.signatures[i].table4_item);
  }
  CHECK(slow.orders[1].order == Approx(87.3 / (605.0 / 60)));
  CHECK(fast.orders[1].order == Approx(263.7 / (1815.0 / 60)));
  CHECK_THROWS_AS(published_table4(std::nan("")), std::invalid_argument);
}

}  // namespace rvbench::analysis
