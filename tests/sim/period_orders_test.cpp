#include "sim/period_orders.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "hal/types/units.hpp"
#include "sim/draw.hpp"
#include "sim/order_lines.hpp"

using namespace rvbench;
using Complex = std::complex<double>;

namespace {

// Of a reducer of 121: a mesh of 9 teeth with two harmonics, 40 pins, an inverter's shaft.
const std::set<int> mesh{1080, 2160}, pins{1560}, misaligned{242}, crank{39};

bool has(const sim::PeriodOrders& at, int order) {
  return std::ranges::find(at.orders(), order) != at.orders().end();
}

}  // namespace

TEST_CASE("terms that have an order in common bring all its multiples", "[sim][orders]") {
  const sim::PeriodOrders at({mesh, {}, pins}, 2200);
  REQUIRE(at.orders().size() == 18);  // of 120
  for (std::size_t i = 0; i < 18; ++i) CHECK(at.orders()[i] == 120 * int(i + 1));
}

TEST_CASE("a term that shares none stands beside them, and beside each of them", "[sim][orders]") {
  const sim::PeriodOrders at({misaligned, mesh, crank, pins}, 2200);
  for (const int order : {120, 2160, 242, 484, 39, 78, 1080 - 242, 1080 + 242, 1560 + 39, 242 - 39,
                          242 + 39, 120 - 39, 242 - 2 * 120}) {
    CHECK(has(at, order));
  }
  for (const int order : {1, 3, 121, 1080 - 242 - 39}) CHECK_FALSE(has(at, order));
  CHECK(at.orders().size() < 100);  // not 2200
  CHECK(std::ranges::is_sorted(at.orders()));
  CHECK(at.samples() < 2200);
}

TEST_CASE("no order is told that was not asked for", "[sim][orders]") {
  CHECK(sim::PeriodOrders({{3}}, 2).orders().empty());
  CHECK(sim::PeriodOrders({{}, {}}, 100).orders().empty());
  CHECK(sim::PeriodOrders({{3}}, 8).orders() == std::vector<int>{3, 6});
}

TEST_CASE("few samples give back every line, and nothing of what a product of two brings",
          "[sim][orders]") {
  const sim::PeriodOrders at({misaligned, mesh, crank, pins}, 2200);
  sim::Draw draw(3);
  Eigen::MatrixXcd lines(2, Eigen::Index(at.orders().size()) + 1);
  for (Complex& line : lines.reshaped()) line = {draw.uniform(-1, 1), draw.uniform(-1, 1)};
  lines.col(0) = lines.col(0).real();
  sim::Signals signals = over_period(lines, at);
  REQUIRE(signals.cols() == at.samples());

  THEN("samples are the sum of the lines") {
    for (const Eigen::Index i : {Eigen::Index(0), Eigen::Index(1), at.samples() - 1}) {
      double sum = lines(0, 0).real();
      for (Eigen::Index k = 1; k < lines.cols(); ++k) {
        const double angle_rad =
            units::two_pi * at.orders()[std::size_t(k - 1)] * double(i) / double(at.samples());
        sum += (lines(0, k) * std::polar(1.0, angle_rad)).real();
      }
      CHECK(signals(0, i) == Approx(sum).margin(1e-9));
    }
  }
  THEN("lines come back, though higher ones are there") {
    for (Eigen::Index i = 0; i < at.samples(); ++i) {
      const double turn_rad = units::two_pi * double(i) / double(at.samples());
      signals(0, i) += std::cos((2160 + 2040) * turn_rad) + std::sin((2160 + 1800 + 39) * turn_rad);
    }
    CHECK((lines_of(signals, at) - lines).cwiseAbs().maxCoeff() < 1e-9);
  }
}
