#include "bench/uniform_time.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

Eigen::VectorXd even_times(Eigen::Index n, double step_s) {
  return Eigen::VectorXd::LinSpaced(n, 5, 5 + step_s * static_cast<double>(n - 1));
}

std::string refusal(const Eigen::VectorXd& time_s) {
  const auto made = uniform_time(time_s, unknown);
  REQUIRE(made.index() == 1);
  return std::get<std::string>(made);
}

}  // namespace

TEST_CASE("even time stamps are taken as they are", "[bench][explain]") {
  const auto made = uniform_time(even_times(1001, 0.01), unknown);
  REQUIRE(made.index() == 0);
  const UniformTime time = std::get<UniformTime>(made);
  CHECK(time.rate_Hz == Approx(100));
  CHECK(time.samples == 1001);
  CHECK(time.start_s == 5);
  CHECK_FALSE(time.resampled);
}

TEST_CASE("uneven time stamps are resampled, and a straight line stays one", "[bench][explain]") {
  Eigen::VectorXd time_s = even_times(1001, 0.01);
  for (Eigen::Index i = 1; i + 1 < time_s.size(); ++i) time_s[i] += 0.003 * std::sin(double(i));
  const auto made = uniform_time(time_s, 100);
  REQUIRE(made.index() == 0);
  const UniformTime time = std::get<UniformTime>(made);
  REQUIRE(time.resampled);
  const Eigen::VectorXd line = 3 * time_s.array() - 1;
  const Eigen::VectorXd even = resampled(time_s, line, time);
  REQUIRE(even.size() == time.samples);
  for (Eigen::Index i = 0; i < even.size(); ++i) {
    const double t_s = time.start_s + static_cast<double>(i) / 100;
    CHECK(even[i] == Approx(3 * t_s - 1).margin(1e-9));
  }
}

TEST_CASE("time that stands still, turns back or leaves a gap is refused", "[bench][explain]") {
  Eigen::VectorXd still = even_times(100, 0.01);
  still[50] = still[49];
  CHECK_THAT(refusal(still), Contains("time does not rise from row 50"));
  Eigen::VectorXd back = even_times(100, 0.01);
  back[50] -= 0.1;
  CHECK_THAT(refusal(back), Contains("time does not rise"));
  Eigen::VectorXd gap = even_times(100, 0.01);
  gap.tail(40).array() += 1;
  CHECK_THAT(refusal(gap), Contains("a gap of 1.01 s after 5.59 s"));
  CHECK_THAT(refusal(Eigen::VectorXd::Zero(1)), Contains("fewer than 2"));
}

}  // namespace rvbench::bench
