#include "bench/lost_rows.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/support/signals.hpp"

namespace rvbench::bench {
namespace {

constexpr Eigen::Index rows = 8000;
constexpr double rate_Hz = 2000;

Eigen::VectorXd even_time() { return Eigen::VectorXd::LinSpaced(rows, 0, (rows - 1) / rate_Hz); }

// A clock shows nothing that is earlier than what it has shown.
Eigen::VectorXd rising(Eigen::VectorXd time) {
  for (Eigen::Index i = 1; i < time.size(); ++i) time[i] = std::max(time[i], time[i - 1]);
  return time;
}

Eigen::VectorXd without(const Eigen::VectorXd& time, Eigen::Index from, Eigen::Index count) {
  Eigen::VectorXd left(time.size() - count);
  left << time.head(from), time.tail(time.size() - from - count);
  return left;
}

Eigen::VectorXd printed(const Eigen::VectorXd& time, double step) {
  return step * (time / step).array().round();
}

Eigen::VectorXd jittering(double steps, unsigned seed) {
  return rising(even_time() + steps / rate_Hz * test::white_noise(rows, seed));
}

}  // namespace

TEST_CASE("rows that are missing are found, wherever they are", "[bench]") {
  const Eigen::Index from = GENERATE(3, 10, 1000, 4000, 7990);
  const Eigen::Index count = GENERATE(1, 2, 5);
  CAPTURE(from, count);
  for (const double unit : {1.0, 1e3, 1e6}) {
    const auto lost = find_lost_rows(unit * without(even_time(), from, count));
    REQUIRE(lost);
    CHECK(lost->before == from);
    CHECK(lost->count == Approx(double(count)).epsilon(1e-6));
  }
}

TEST_CASE("of several gaps the largest is told", "[bench]") {
  const auto lost = find_lost_rows(without(without(even_time(), 5000, 200), 1000, 10));
  REQUIRE(lost);
  CHECK(lost->before == 4990);
  CHECK(lost->count == Approx(200).margin(1));
}

TEST_CASE("rows are missed behind a coarse print and a jitter too", "[bench]") {
  // In whole milliseconds every stamp comes twice.
  const auto coarse = find_lost_rows(without(printed(even_time(), 1e-3), 4000, 3));
  REQUIRE(coarse);
  CHECK(std::abs(double(coarse->before) - 4000) <= 2);
  CHECK(coarse->count == Approx(3).margin(0.5));
  const auto jitter = find_lost_rows(without(jittering(0.2, 1), 4000, 3));
  REQUIRE(jitter);
  CHECK(std::abs(double(jitter->before) - 4000) <= 2);
}

TEST_CASE("a clock that misses no row has no gap, however badly it runs", "[bench]") {
  CHECK_FALSE(find_lost_rows(even_time()));
  CHECK_FALSE(find_lost_rows(even_time().array() + 1e6));
  for (const double step : {1e-5, 1e-4, 1e-3, 4e-3}) {
    CAPTURE(step);
    CHECK_FALSE(find_lost_rows(printed(even_time(), step)));
  }
  // Its halves of a millisecond are rounded up, so that the last stamp comes alone.
  CHECK_FALSE(find_lost_rows(1e-3 * (1e3 * even_time().array() + 0.25).round()));
  // It drifts by 2e-4 to and fro.
  CHECK_FALSE(find_lost_rows(even_time().array() * (1 + 2e-4 * (3 * even_time()).array().sin())));
  for (const double steps : {0.1, 0.3, 1.0, 3.0}) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      CAPTURE(steps, seed);
      CHECK_FALSE(find_lost_rows(jittering(steps, seed)));
    }
  }
  // Now and then a stamp comes 20 rows late, and those behind it with it.
  Eigen::VectorXd late = even_time();
  for (Eigen::Index i = 100; i < rows; i += 997) late[i] += 20 / rate_Hz;
  CHECK_FALSE(find_lost_rows(rising(late)));
  // Rows come in blocks of 32, each with the stamp of its last.
  Eigen::VectorXd blocks = even_time();
  for (Eigen::Index i = 0; i < rows; ++i) blocks[i] = (double(i / 32) * 32 + 31) / rate_Hz;
  CHECK_FALSE(find_lost_rows(blocks));
  CHECK_FALSE(find_lost_rows(without(even_time(), 50, rows - 99)));  // too few to say
  CHECK_FALSE(find_lost_rows(Eigen::VectorXd::Zero(rows)));
}

}  // namespace rvbench::bench
