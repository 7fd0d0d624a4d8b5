#include "analysis/table4.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/diagnosis.hpp"
#include "tests/analysis/order_signals.hpp"

namespace rvbench::analysis {
namespace {

// 4 output turns at 1815 rpm, and a little more.
const test::OrderSignals turning{.speed_Hz = 30.25, .rate_Hz = 2000, .count = 32100};
constexpr double carrier = 20;

Diagnosis judged_by_table4(const Eigen::VectorXd& x) {
  const Kinematics published = published_table4(1815);
  return conclude({examine(turning.recording(x + 0.2 * turning.noise(1)), published)}, published);
}

}  // namespace

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

TEST_CASE("the row printed as drive shaft is the sun against the carrier, at nominal speed",
          "[analysis][literature]") {
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(table4()[0].frequency_Hz[i] == Approx(120.0 / 121 * table4_speeds_rpm[i] / 60));
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

TEST_CASE("a line that the table prints is found, though it repeats with the gear train",
          "[analysis]") {
  struct Row {
    const char* component;
    double order;  // the part's own
  };
  // 78/121 is printed as 19.5 Hz, the rounded 39/121 as 9.5 Hz: 38/121 is that, to its digits.
  const auto row = GENERATE(Row{"pin_housing", 78.0 / 121}, Row{"cycloid_disc", 38.0 / 121});
  CAPTURE(row.component);
  const Diagnosis d = judged_by_table4(turning.modulated(carrier, row.order, 0.4));
  REQUIRE(d.findings.size() == 1);
  CHECK(d.findings.front().component == row.component);
  CHECK(d.findings.front().order == Approx(row.order).margin(0.5 / 4 / 121));
  CHECK(d.findings.front().severity == Approx(0.4).epsilon(0.1));
}

TEST_CASE("what the table does not print to its digits is not found by it", "[analysis]") {
  CHECK(judged_by_table4(turning.tone(carrier)).findings.empty());
  // The shaft at 1815 rpm turns 30.25 times a second, printed is 30.0: it is the sun's row.
  CHECK(judged_by_table4(turning.modulated(carrier, 1, 0.4)).findings.empty());
}

}  // namespace rvbench::analysis
