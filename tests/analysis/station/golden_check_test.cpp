#include "analysis/station/golden_check.hpp"

#include <catch2/catch.hpp>

#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::check_golden;
using analysis::GoldenCheck;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

// An indicator of the golden unit, of 20 sound runs and so many after them.
Eigen::VectorXd runs(Eigen::Index after, unsigned seed = 3) {
  return 2 + 0.05 * test::white_noise(20 + after, seed).array();
}

GoldenCheck checked(const Eigen::VectorXd& values) {
  return std::get<GoldenCheck>(check_golden(values));
}

}  // namespace

TEST_CASE("a golden unit that reads as ever says that the station is in control",
          "[analysis][station]") {
  int out = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    out += checked(runs(1, seed)).is_in_control() ? 0 : 1;
  }
  // Chance: a few in a hundred, for a centre and σ of 20 runs.
  CHECK(out < 20);
  Eigen::VectorXd usual = runs(1);
  usual[20] = 2;
  CHECK(checked(usual).text() == "in control");
}

TEST_CASE("a golden unit that jumps is out, and the rule is named", "[analysis][station]") {
  Eigen::VectorXd values = runs(1);
  values[20] = 2.5;
  const GoldenCheck check = checked(values);
  CHECK_FALSE(check.is_in_control());
  CHECK(check.is_wide);
  CHECK_THAT(check.text(), StartsWith("out of control: western_electric_1 (beyond 3 sigma)"));
  CHECK_THAT(check.text(), Contains("moving range"));
}

TEST_CASE("a golden unit that drifts is out though no run is far off", "[analysis][station]") {
  Eigen::VectorXd values = runs(12);
  for (Eigen::Index i = 20; i < 32; ++i) values[i] = 2 + 0.08 + (i % 2 == 0 ? 0.01 : -0.01);
  const GoldenCheck check = checked(values);
  CHECK(check.has_drifted);
  CHECK_THAT(check.text(), Contains("a drift"));
  CHECK_THAT(check.text(), !Contains("western_electric_1 "));
}

TEST_CASE("what was out once does not count against later runs", "[analysis][station]") {
  Eigen::VectorXd values = runs(3);
  values[20] = 2.5;
  values[21] = values[22] = 2;
  CHECK(checked(values).fired.empty());
  CHECK_FALSE(checked(values).is_wide);
}

TEST_CASE("no chart of the golden unit without enough runs", "[analysis][station]") {
  const auto refusal = [](const Eigen::VectorXd& values) {
    return std::get<std::string>(check_golden(values));
  };
  CHECK(refusal(runs(0)) ==
        "20 runs of the golden unit: its chart takes 20, and the one that is checked");
  CHECK_THAT(refusal(Eigen::VectorXd::Constant(21, 2)), Contains("all alike"));
  CHECK_THAT(refusal(8e307 * runs(1)), Contains("cannot tell"));
  CHECK_THROWS_AS(check_golden(runs(1), 5), std::invalid_argument);
  CHECK_THROWS_AS(check_golden(Eigen::VectorXd::Constant(30, NAN)), std::invalid_argument);
}
