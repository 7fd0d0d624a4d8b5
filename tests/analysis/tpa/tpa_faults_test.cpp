#include "analysis/tpa/tpa_faults.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/tpa/coherent_lines.hpp"
#include "analysis/tpa/sensor_change.hpp"
#include "analysis/tpa/unexplained_power.hpp"
#include "tests/analysis/tpa/path_problem.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using Catch::Matchers::Contains;
using Eigen::Index;
using test::PathProblem;

namespace {

/// As measured: FRFs off by 2 %, sensors by 1 %.
PathProblem measured(unsigned seed) {
  PathProblem problem(seed);
  problem.add_sensor_noise(0.02, seed + 7);
  problem.add_frf_errors(0.02, seed + 8);
  return problem;
}

std::vector<TpaFault> faults_of(const PathProblem& problem) {
  return faults_of_inversion(problem.frfs, problem.operating, problem.roles, problem.solved());
}

}  // namespace

TEST_CASE("sound data have no fault", "[tpa][null]") {
  const PathProblem problem = measured(GENERATE(range(1u, 21u)));
  CHECK(faults_of(problem).empty());
  CHECK_FALSE(find_sensor_change(problem.frfs, problem.operating, problem.roles));
  CHECK(faults_before_inversion(8, 4, std::vector<bool>(40, true)).empty());
}

TEST_CASE("of sound data as much is unexplained as is expected", "[tpa]") {
  const PathProblem problem = measured(GENERATE(range(1u, 6u)));
  const UnexplainedPower power =
      unexplained_power(problem.frfs, problem.operating, problem.roles, problem.solved());
  CHECK(power.share() < 0.01);
  CHECK(power.share() / power.expected_share() > 0.4);
  CHECK(power.share() / power.expected_share() < 1.2);
}

TEST_CASE("a force that acts where no path was measured is missed", "[tpa]") {
  PathProblem problem = measured(GENERATE(range(1u, 6u)));
  // Strongest at one indicator, which it is next to.
  Eigen::VectorXcd response = test::complex_noise(12, 1, 3);
  response[4] *= 10;
  // At a quarter of the lines, as the orders of a machine lie.
  for (Index line = 0; line < PathProblem::lines; line += 4) {
    problem.operating.values[line] +=
        0.3 * response * test::complex_noise(1, PathProblem::blocks, 200 + unsigned(line));
  }
  const auto faults = faults_of(problem);
  REQUIRE_FALSE(faults.empty());
  CHECK(faults.front().kind == TpaFaultKind::missing_path);
  CHECK(faults.front().where == "near B +Y");
}

TEST_CASE("a sensor with the other sign is named", "[tpa]") {
  const unsigned seed = GENERATE(range(1u, 6u));
  PathProblem problem = measured(seed);
  const Index sensor = Index(seed) % PathProblem::indicators;
  for (Index line = 0; line < PathProblem::lines; ++line) {
    problem.operating.values[line].row(sensor) *= -1;
  }
  const auto faults = faults_of(problem);
  REQUIRE_FALSE(faults.empty());
  CHECK(faults.front().kind == TpaFaultKind::sign_reversed);
  CHECK(PathProblem::places(sensor, sensor + 1)[0].point + " " +
            PathProblem::places(sensor, sensor + 1)[0].direction ==
        faults.front().where);
}

TEST_CASE("two directions that were exchanged are named", "[tpa]") {
  PathProblem problem = measured(3);
  for (Index line = 0; line < PathProblem::lines; ++line) {
    auto values = problem.operating.values[line];
    values.row(3).swap(values.row(5));
  }
  const auto faults = faults_of(problem);
  REQUIRE_FALSE(faults.empty());
  CHECK(faults.front().kind == TpaFaultKind::directions_swapped);
  CHECK(faults.front().where == "B +X and B +Z");
  CHECK_THAT(faults.front().reason, Contains("of the indicators' power"));
}

TEST_CASE("paths that the FRFs' errors do not tell apart are counted", "[tpa]") {
  PathProblem problem = measured(4);
  for (Index line = 0; line < PathProblem::lines; ++line) {
    problem.frfs.values[line].col(2) = 1.001 * problem.frfs.values[line].col(0);
  }
  const auto faults = faults_of(problem);
  REQUIRE_FALSE(faults.empty());
  CHECK(faults.front().kind == TpaFaultKind::rank_below_paths);
  CHECK(faults.front().where == "at 40 of 40 lines");
  CHECK_THAT(faults.front().reason, Contains("3 of 4 forces"));
}

TEST_CASE("what does not follow from the paths is not validated", "[tpa]") {
  PathProblem problem = measured(5);
  for (Index line = 0; line < PathProblem::lines; ++line) {
    problem.operating.values[line].bottomRows(2) =
        test::complex_noise(2, PathProblem::blocks, 500 + unsigned(line));
  }
  const auto faults = faults_of(problem);
  REQUIRE(faults.size() == 1);
  CHECK(faults.front().kind == TpaFaultKind::not_validated);
}

TEST_CASE("too few indicators are told before anything is inverted", "[tpa]") {
  const std::vector<bool> all(10, true);
  REQUIRE(faults_before_inversion(17, 18, all).size() == 1);
  CHECK(faults_before_inversion(17, 18, all)[0].where == "17 indicators for 18 paths");
  CHECK_THAT(faults_before_inversion(18, 18, all)[0].reason, Contains("nothing is left to check"));
  CHECK(faults_before_inversion(19, 18, all).empty());
}

TEST_CASE("incoherent lines are left out and counted", "[tpa]") {
  FrequencyResponse strong;
  strong.step_Hz = 1;
  strong.values = Eigen::VectorXcd::Ones(6);
  strong.coherence = (Eigen::VectorXd(6) << 1, 0.9, 0.3, 1, 0.79, 0.81).finished();
  FrequencyResponse weak = strong;  // near an antiresonance everywhere
  weak.values *= 0.01;
  weak.coherence.setConstant(0.1);
  const CoherentLines lines = coherent_lines({strong, weak});
  CHECK(lines.is_used == std::vector<bool>{true, true, false, true, false, true});
  CHECK(lines.left_out == 2);
  CHECK(lines.coherence[2] == Approx(0.3).margin(1e-4));
  const auto faults = faults_before_inversion(36, 18, lines.is_used);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].kind == TpaFaultKind::incoherent_lines);
  CHECK(faults[0].where == "at 2 of 6 lines");
  strong.coherence.resize(0);
  CHECK(coherent_lines({strong}).left_out == 0);
  CHECK_THROWS_AS(coherent_lines({}), std::invalid_argument);
}
