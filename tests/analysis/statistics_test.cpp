#include "analysis/statistics.hpp"

#include <cmath>
#include <random>

#include "tests/analysis/null_rates.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::combined_p_value;
using analysis::correlation;
using analysis::kurtosis;
using analysis::line_p_value;
using analysis::median;
using test::UniformBelow;

TEST_CASE("the median is the middle value, or midway between the two", "[analysis][statistics]") {
  CHECK(median({3}) == 3);
  CHECK(median({9, 1, 5}) == 5);
  CHECK(median({8, 1, 2, 4}) == 3);
  CHECK(median({1, 1, 1, 1e300}) == 1);
  CHECK_THROWS_AS(median({}), std::invalid_argument);
}

TEST_CASE("a median of normal values varies as stated", "[analysis][statistics]") {
  constexpr int draws = 2000, values = 51;
  const Eigen::VectorXd noise = test::white_noise(draws * values, 17);
  double squares = 0;
  for (int draw = 0; draw < draws; ++draw) {
    const auto some = noise.segment(draw * values, values);
    squares += std::pow(median({some.begin(), some.end()}), 2);
  }
  CHECK(squares / draws ==
        Approx(analysis::variance_of_median(std::vector<double>(values, 1.0))).epsilon(0.08));
}

TEST_CASE("a guess of the median, good or bad, changes nothing of it", "[analysis][statistics]") {
  const int count = GENERATE(1, 2, 5, 100, 101);
  const Eigen::VectorXd power = test::white_noise(count, 4).array().square();
  const std::vector<double> values(power.begin(), power.end());
  const double middle = median(values);
  for (const double factor : {1.0, 1.2, 0.7, 3.0, 0.01, 0.0, -1.0}) {
    CAPTURE(count, factor);
    CHECK(analysis::median_near(factor * middle, values) == middle);
  }
  CHECK(analysis::median_near(1, {1, 1, 1, 1}) == 1);
  CHECK(analysis::median_near(2, {0, 0, 0, 2}) == 0);
  CHECK_THROWS_AS(analysis::median_near(1, {}), std::invalid_argument);
}

TEST_CASE("Student's t has the tails of the tables", "[analysis][statistics][literature]") {
  // Fisher & Yates, Statistical Tables, table III: 2.228 at 10 degrees of freedom is 5 %.
  CHECK(analysis::t_p_value(2.228, 10) == Approx(0.05).epsilon(1e-3));
  CHECK(analysis::t_p_value(-2.228, 10) == analysis::t_p_value(2.228, 10));
  CHECK(analysis::t_p_value(63.657, 1) == Approx(0.01).epsilon(1e-3));
  CHECK(analysis::t_p_value(0, 5) == 1);
}

TEST_CASE("correlation is that of the textbook", "[analysis][statistics][literature]") {
  // Anscombe, The American Statistician 27(1), 17-21 (1973), set 1: r = 0.816
  Eigen::VectorXd x(11), y(11);
  x << 10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5;
  y << 8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68;
  CHECK(correlation(x, y) == Approx(0.81642).margin(5e-6));
  CHECK(correlation(y, x) == correlation(x, y));
}

TEST_CASE("correlation knows neither unit nor offset, only the sign", "[analysis][statistics]") {
  const Eigen::VectorXd x = test::white_noise(500, 1);
  const Eigen::VectorXd scaled = -1e-6 * x.array() + 5;
  CHECK(correlation(x, scaled) == Approx(-1).epsilon(1e-9));
  CHECK(correlation(test::tone(10, 1000, 1000), test::tone(20, 1000, 1000)) ==
        Approx(0).margin(1e-12));
  CHECK(correlation(x, Eigen::VectorXd::Constant(500, 3)) == 0);
}

TEST_CASE("kurtosis of signals whose moments are known", "[analysis][statistics]") {
  CHECK(kurtosis(test::tone(10, 1000, 1000)) == Approx(1.5));
  CHECK(kurtosis(Eigen::VectorXd::LinSpaced(10001, -1, 1)) == Approx(1.8).epsilon(1e-3));
  // One blow in n samples: n − 2 + 1/(n − 1).
  Eigen::VectorXd blow = Eigen::VectorXd::Zero(100);
  blow[37] = -4;
  CHECK(kurtosis(blow) == Approx(98 + 1.0 / 99));
  // Standard error of a Gaussian's kurtosis is √(24/n).
  CHECK(kurtosis(test::white_noise(60000, 2)) == Approx(3).margin(4 * std::sqrt(24.0 / 60000)));
  CHECK(kurtosis(Eigen::VectorXd::Constant(10, 7)) == 0);
}

TEST_CASE("the p-value of lines is the tail of the F distribution",
          "[analysis][statistics][literature]") {
  // Upper points of F(2·lines, 2·floor_lines), three digits as tabulated: Abramowitz & Stegun,
  // table 26.9. The statistic is lines·F.
  struct Point {
    double f, lines, floor_lines, p;
  };
  const auto point =
      GENERATE(Point{4.10, 1, 5, 0.05}, Point{7.56, 1, 5, 0.01}, Point{2.87, 2, 10, 0.05},
               Point{4.43, 2, 10, 0.01}, Point{4.79, 1, 60, 0.01}, Point{1.91, 5, 60, 0.05});
  CAPTURE(point.lines, point.floor_lines);
  CHECK(line_p_value(point.lines * point.f, point.lines, point.floor_lines) ==
        Approx(point.p).epsilon(0.01));
}

TEST_CASE("a line over a floor that is known well is exponentially rare",
          "[analysis][statistics]") {
  // lines = 1: (1 + s/M)^−M, which goes to exp(−s)
  for (const double s : {0.1, 1.0, 10.0, 60.0}) {
    CAPTURE(s);
    CHECK(line_p_value(s, 1, 80) == Approx(std::pow(1 + s / 80, -80)));
    CHECK(line_p_value(s, 1, 1e7) == Approx(std::exp(-s)).epsilon(1e-3));
  }
  CHECK(line_p_value(0, 3, 80) == 1);
  CHECK(line_p_value(-1, 3, 80) == 1);
}

TEST_CASE("p-values of noise lines are uniform, however few lines give the floor",
          "[analysis][statistics][null]") {
  const int lines = GENERATE(1, 2, 17);
  const int floor_lines = GENERATE(6, 100);
  CAPTURE(lines, floor_lines);
  std::mt19937 generator(3);
  std::exponential_distribution<double> power;
  const auto sum_of = [&](int count) {
    double sum = 0;
    for (int i = 0; i < count; ++i) sum += power(generator);
    return sum;
  };
  test::NullDraws draws;
  for (int draw = 0; draw < 4000; ++draw) {
    const double floor = sum_of(floor_lines) / floor_lines;
    draws.p_values.push_back(line_p_value(sum_of(lines) / floor, lines, floor_lines));
  }
  CHECK_THAT(draws, UniformBelow({0.001, 0.01, 0.1, 0.5, 0.9}));
}

TEST_CASE("two p-values combine as Fisher has it", "[analysis][statistics]") {
  // The product P of two uniform numbers falls below p with probability p·(1 − ln p).
  CHECK(combined_p_value({0.05, 0.05}) == Approx(0.0025 * (1 - std::log(0.0025))));
  CHECK(combined_p_value({0.2, 1}) == Approx(0.2 * (1 - std::log(0.2))));
  CHECK(combined_p_value({0.03}) == Approx(0.03));
  CHECK(combined_p_value({}) == 1);
  CHECK(combined_p_value({1, 1, 1}) == 1);
  CHECK(combined_p_value({0, 0.5}) < 1e-290);
}

TEST_CASE("the gamma tail is Fisher's combination, also where that is too small for a double",
          "[analysis][statistics]") {
  using analysis::minus_log_gamma_tail;
  CHECK(minus_log_gamma_tail(3.7, 1) == Approx(3.7));
  for (const double p : {0.9, 0.2, 1e-3}) {
    const double sum = -12 * std::log(p);
    CHECK(minus_log_gamma_tail(sum, 12) ==
          Approx(-std::log(combined_p_value(std::vector<double>(12, p)))));
  }
  // Far out the last term of its series is nearly all of it: sum - ln sum for two.
  CHECK(minus_log_gamma_tail(1e4, 2) == Approx(1e4 - std::log(1e4 + 1)).epsilon(1e-12));
  CHECK(std::isfinite(minus_log_gamma_tail(1e5, 64)));
}

TEST_CASE("Student's t for a probability is that of the tables",
          "[analysis][statistics][literature]") {
  // Fisher & Yates, table III, at 10 %.
  CHECK(analysis::t_of_p_value(0.1, 1) == Approx(6.314).epsilon(1e-4));
  CHECK(analysis::t_of_p_value(0.1, 3) == Approx(2.353).epsilon(2e-4));
  CHECK(analysis::t_of_p_value(0.1, 1e6) == Approx(1.645).epsilon(1e-4));
  CHECK(analysis::t_p_value(analysis::t_of_p_value(0.37, 7), 7) == Approx(0.37));
  CHECK_THROWS_AS(analysis::t_of_p_value(0, 7), std::invalid_argument);
  CHECK_THROWS_AS(analysis::t_of_p_value(0.1, 0.5), std::invalid_argument);
}

TEST_CASE("combined p-values of nothing are uniform", "[analysis][statistics][null]") {
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> uniform;
  test::NullDraws combined;
  for (int draw = 0; draw < 4000; ++draw) {
    std::vector<double> p_values(5);
    for (double& p : p_values) p = uniform(generator);
    combined.p_values.push_back(combined_p_value(p_values));
  }
  CHECK_THAT(combined, UniformBelow({0.001, 0.01, 0.1, 0.5, 0.9}));
}
