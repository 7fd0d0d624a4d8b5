#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <numbers>

#include "analysis/statistics.hpp"
#include "analysis/tpa/picard_powers.hpp"
#include "analysis/tpa/regularised_inverse.hpp"
#include "analysis/tpa/tikhonov_by_evidence.hpp"
#include "analysis/tpa/tikhonov_by_gcv.hpp"
#include "analysis/tpa/tikhonov_by_l_curve.hpp"
#include "analysis/tpa/truncation_by_condition.hpp"
#include "analysis/tpa/truncation_by_l_curve.hpp"
#include "analysis/tpa/truncation_by_noise.hpp"
#include "tests/analysis/tpa/random_matrices.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using Eigen::Index;
using test::complex_noise, test::graded, test::one_line, test::with_singular_values;

namespace {

/// A x = b.
struct Problem {
  Eigen::MatrixXcd a;
  Eigen::VectorXcd x;
};

/// Shaw's image restoration as Hansen discretises it (Regularization Tools, `shaw`).
Problem shaw(Index n) {
  const double h = std::numbers::pi / double(n);
  const auto angle = [&](Index i) { return (double(i) + 0.5) * h - std::numbers::pi / 2; };
  Problem problem{Eigen::MatrixXcd(n, n), Eigen::VectorXcd(n)};
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const double u = std::numbers::pi * (std::sin(angle(i)) + std::sin(angle(j)));
      const double slit = std::abs(u) < 1e-12 ? 1 : std::sin(u) / u;
      problem.a(i, j) = h * std::pow((std::cos(angle(i)) + std::cos(angle(j))) * slit, 2);
    }
    const double t = angle(i);
    problem.x[i] = 2 * std::exp(-6 * (t - 0.8) * (t - 0.8)) + std::exp(-2 * (t + 0.5) * (t + 0.5));
  }
  return problem;
}

/// Phillips' integral equation by midpoints on -6 ... 6; its solution is 1 + cos(πt/3) within ±3.
Problem phillips(Index n) {
  const double h = 12 / double(n);
  const auto bump = [](double t) {
    return std::abs(t) < 3 ? 1 + std::cos(t * std::numbers::pi / 3) : 0;
  };
  const auto at = [&](Index i) { return -6 + (double(i) + 0.5) * h; };
  Problem problem{Eigen::MatrixXcd(n, n), Eigen::VectorXcd(n)};
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) problem.a(i, j) = h * bump(at(i) - at(j));
    problem.x[i] = bump(at(i));
  }
  return problem;
}

/// Paths that nearly depend on each other, more responses than forces: as TPA has it.
Problem paths() { return {with_singular_values(graded(18, 1e6), 36, 3), complex_noise(18, 1, 5)}; }

double error_of(const LineSvd& svd, const Regularisation& rule, const Eigen::VectorXcd& b,
                const Eigen::VectorXcd& x) {
  return (regularised_inverse(svd, {rule}, 1).values[0] * b - x).norm() / x.norm();
}

double least_error(const LineSvd& svd, const Eigen::VectorXcd& b, const Eigen::VectorXcd& x,
                   bool truncates) {
  const Index n = svd.right.rows;
  double least = 1;
  if (truncates) {
    for (Index kept = 0; kept <= n; ++kept) {
      least = std::min(least, error_of(svd, {.kept = kept}, b, x));
    }
    return least;
  }
  for (double exponent = -16; exponent < 1; exponent += 0.05) {
    const double parameter = svd.singular_values(0, 0) * std::pow(10, exponent);
    least = std::min(least, error_of(svd, {.kept = n, .parameter = parameter}, b, x));
  }
  return least;
}

struct Rule {
  std::string name;
  std::function<Regularisation(const PicardPowers&)> chosen;
  bool truncates = false;
};

const std::vector<Rule>& rules_that_ask_the_data() {
  static const std::vector<Rule> rules{{"GCV", tikhonov_by_gcv},
                                       {"L-curve", tikhonov_by_l_curve},
                                       {"evidence", tikhonov_by_evidence},
                                       {"truncated L-curve", truncate_by_l_curve, true}};
  return rules;
}

}  // namespace

TEST_CASE(
    "for paths each rule comes near the best that can be done, for Hansen's smooth solutions "
    "GCV alone; plain inversion fails",
    "[analysis][tpa][literature]") {
  const auto [name, problem] = GENERATE(table<std::string, Problem>(
      {{"shaw", shaw(20)}, {"phillips", phillips(24)}, {"paths", paths()}}));
  const LineSvd svd = line_svd(one_line(problem.a), 1);
  const Eigen::VectorXcd clean = problem.a * problem.x;
  constexpr unsigned trials = 20;
  for (const Rule& rule : rules_that_ask_the_data()) {
    // Evidence takes forces as of one size, and smooth solutions have an L-curve without a corner.
    if (name != "paths" && rule.name != "GCV") continue;
    std::vector<double> times_best, plain;
    for (unsigned seed = 0; seed < trials; ++seed) {
      const Eigen::VectorXcd noise = complex_noise(clean.size(), 1, 1000 + seed);
      const Eigen::VectorXcd b = clean + 1e-3 * clean.norm() / noise.norm() * noise;
      const Regularisation chosen = rule.chosen(picard_powers(svd, 0, b));
      times_best.push_back(error_of(svd, chosen, b, problem.x) /
                           least_error(svd, b, problem.x, rule.truncates));
      plain.push_back(error_of(svd, {.kept = svd.right.rows}, b, problem.x));
    }
    CAPTURE(name, rule.name, median(times_best), median(plain));
    CHECK(median(times_best) < 2);
    if (name != "phillips") CHECK(median(plain) > 10);
  }
}

TEST_CASE("a line in good condition is inverted exactly, by every rule", "[analysis][tpa]") {
  const Eigen::MatrixXcd a = with_singular_values(graded(6, 10), 9, 1);
  const Eigen::VectorXcd x = complex_noise(6, 1, 2);
  const LineSvd svd = line_svd(one_line(a), 1);
  const PicardPowers line = picard_powers(svd, 0, a * x);
  const Eigen::VectorXd s = svd.singular_values.col(0);
  for (const Regularisation& rule :
       {truncate_by_condition(s, 100), truncate_by_noise(s, 1e-3), truncate_by_l_curve(line),
        tikhonov_by_gcv(line), tikhonov_by_evidence(line)}) {
    CHECK(rule.kept == 6);
    CHECK(error_of(svd, rule, a * x, x) < 1e-10);
  }
  const RegularisedInverse inverse = regularised_inverse(svd, {{.kept = 6}}, 1);
  CHECK((inverse.values[0] * a - Eigen::MatrixXcd::Identity(6, 6)).norm() < 1e-13);
  CHECK(inverse.conditions[0] == Approx(10));
}

TEST_CASE("a truncated inverse is the one of the matrix without its small parts",
          "[analysis][tpa][law]") {
  // Moore and Penrose's four conditions, of the matrix that its first singular values make.
  Eigen::VectorXd s = graded(18, 1e10);
  s.tail(6).setZero();
  const Eigen::MatrixXcd kept = with_singular_values(s, 36, 7);
  const Eigen::MatrixXcd whole = with_singular_values(graded(18, 1e10), 36, 7);
  const SvdKernels* kernels = GENERATE(&svd_kernels(), &portable_svd_kernels());
  const LineSvd svd = line_svd(one_line(whole), 1, *kernels);
  const Eigen::MatrixXcd inverse = regularised_inverse(svd, {{.kept = 12}}, 1, *kernels).values[0];
  const Eigen::MatrixXcd there = kept * inverse, back = inverse * kept;
  // Rounding times the condition of what is kept, 3e6, over 36 rows.
  CHECK((there * kept - kept).norm() < 1e-8);
  CHECK((inverse * there - inverse).norm() < 1e-8 * inverse.norm());
  CHECK((there - there.adjoint()).norm() < 1e-8);
  CHECK((back - back.adjoint()).norm() < 1e-8);
}

TEST_CASE("Tikhonov's inverse solves its normal equations", "[analysis][tpa][law]") {
  const Eigen::MatrixXcd a = complex_noise(9, 5, 1);
  const LineSvd svd = line_svd(one_line(a), 1);
  const Eigen::MatrixXcd inverse =
      regularised_inverse(svd, {{.kept = 5, .parameter = 0.7}}, 1).values[0];
  const Eigen::MatrixXcd damped = a.adjoint() * a + 0.49 * Eigen::MatrixXcd::Identity(5, 5);
  CHECK((damped * inverse - a.adjoint()).norm() < 1e-13 * a.norm() * a.norm());
}

TEST_CASE("no parameter of a fine grid has less than the one chosen", "[analysis][tpa]") {
  const Problem problem = paths();
  const LineSvd svd = line_svd(one_line(problem.a), 1);
  const Eigen::VectorXcd b = problem.a * problem.x + 1e-4 * complex_noise(36, 1, 9);
  const PicardPowers line = picard_powers(svd, 0, b);
  const double by_gcv = gcv(line, tikhonov_by_gcv(line).parameter);
  const double by_evidence = minus_log_evidence(line, tikhonov_by_evidence(line).parameter);
  const double bend = l_curve_curvature(line, tikhonov_by_l_curve(line).parameter);
  for (double exponent = -6; exponent <= 0; exponent += 1e-3) {
    const double parameter = std::pow(10, exponent);
    CHECK(by_gcv <= gcv(line, parameter) * (1 + 1e-12));
    CHECK(by_evidence <= minus_log_evidence(line, parameter) + 1e-9);
    CHECK(bend >= l_curve_curvature(line, parameter) * (1 - 1e-9));
  }
}

TEST_CASE("the curvature of the L-curve is that of a circle through three of its points",
          "[analysis][tpa]") {
  const Problem problem = paths();
  const Eigen::VectorXcd b = problem.a * problem.x + 1e-3 * complex_noise(36, 1, 9);
  const LineSvd svd = line_svd(one_line(problem.a), 1);
  const PicardPowers line = picard_powers(svd, 0, b);
  const auto point = [&](double parameter) {
    const Eigen::VectorXcd x =
        regularised_inverse(svd, {{.kept = 18, .parameter = parameter}}, 1).values[0] * b;
    return Eigen::Vector2d(std::log((problem.a * x - b).norm()), std::log(x.norm()));
  };
  for (const double parameter : {1e-5, 1e-4, 1e-3, 1e-2, 0.1}) {
    const Eigen::Vector2d p = point(parameter / 1.001), q = point(parameter),
                          r = point(parameter * 1.001);
    const double twice_area = (q - p).x() * (r - p).y() - (q - p).y() * (r - p).x();
    const double circle = 2 * twice_area / ((q - p).norm() * (r - q).norm() * (r - p).norm());
    CHECK(l_curve_curvature(line, parameter) == Approx(circle).epsilon(1e-3).margin(1e-3));
  }
}

TEST_CASE("evidence finds the ratio of noise to force that was drawn", "[analysis][tpa]") {
  const double ratio = GENERATE(0.3, 0.01);
  const Eigen::MatrixXcd a = with_singular_values(graded(18, 1e3), 36, 3);
  const Eigen::MatrixXcd b = a * complex_noise(18, 400, 1) + ratio * complex_noise(36, 400, 2);
  const LineSvd svd = line_svd(one_line(a), 1);
  CHECK(tikhonov_by_evidence(picard_powers(svd, 0, b)).parameter == Approx(ratio).epsilon(0.05));
}

TEST_CASE("singular values of noise lie below its floor, those of paths above", "[analysis][tpa]") {
  constexpr Index lines = 100;
  constexpr double deviation = 1e-3;
  LineMatrices noise(36, 18, lines), six_paths(36, 18, lines);
  const Eigen::MatrixXcd clean =
      complex_noise(36, 6, 1) * complex_noise(6, 18, 2);  // 18 paths that only six forces make
  for (Index line = 0; line < lines; ++line) {
    noise[line] = deviation * complex_noise(36, 18, unsigned(line));
    six_paths[line] = clean + noise[line];
  }
  const double floor = noise_floor(Eigen::MatrixXd::Constant(36, 18, deviation * deviation));
  const LineSvd of_noise = line_svd(noise, 1), of_paths = line_svd(six_paths, 1);
  Index kept_of_noise = 0, wrong = 0;
  for (Index line = 0; line < lines; ++line) {
    kept_of_noise += truncate_by_noise(of_noise.singular_values.col(line), floor).kept;
    wrong += truncate_by_noise(of_paths.singular_values.col(line), floor).kept != 6;
  }
  // By Tracy & Widom's law the largest one is above the floor in 3 % of lines.
  CHECK(kept_of_noise <= 8);
  CHECK(wrong <= 8);
  CHECK(of_noise.singular_values.row(0).mean() > 0.9 * floor);  // no lower than it need be
}

TEST_CASE("floors of a test's lines come from its noise", "[analysis][tpa]") {
  FrfMatrix frfs;
  frfs.values = LineMatrices(2, 1, 2);
  CHECK_THROWS_AS(noise_floors(frfs), std::invalid_argument);
  frfs.noise = Eigen::MatrixXd(2, 2);
  frfs.noise << 9, 0, 16, 0;
  const Eigen::VectorXd floors = noise_floors(frfs);
  CHECK(floors[0] == Approx(4 + 5));
  CHECK(floors[1] == 0);
}

TEST_CASE("a condition keeps what is large enough", "[analysis][tpa]") {
  const Eigen::Vector4d s(10, 5, 0.1, 0);
  CHECK(truncate_by_condition(s, 1).kept == 1);
  CHECK(truncate_by_condition(s, 99).kept == 2);
  CHECK(truncate_by_condition(s, 1e6).kept == 3);
  CHECK(truncate_by_condition(Eigen::Vector3d::Zero(), 10).kept == 0);
  CHECK_THROWS_AS(truncate_by_condition(s, 0.5), std::invalid_argument);
}

TEST_CASE("an inverse that cannot be asked for is refused", "[analysis][tpa]") {
  const LineSvd svd = line_svd(one_line(complex_noise(4, 3, 1)), 1);
  CHECK_THROWS_AS(regularised_inverse(svd, {}), std::invalid_argument);
  CHECK_THROWS_AS(regularised_inverse(svd, {{.kept = 4}}), std::invalid_argument);
  CHECK_THROWS_AS(regularised_inverse(svd, {{.kept = 3, .parameter = -1}}), std::invalid_argument);
  CHECK_THROWS_AS(picard_powers(svd, 0, Eigen::VectorXcd::Zero(3)), std::invalid_argument);
  CHECK(regularised_inverse(svd, {{.kept = 0}}, 1).values.values.isZero(0));
}
