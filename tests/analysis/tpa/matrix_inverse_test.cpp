#include "analysis/tpa/matrix_inverse.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "hal/types/linear_algebra.hpp"
#include "tests/analysis/tpa/path_problem.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using Catch::Matchers::Contains;
using Eigen::Index;
using test::PathProblem;

TEST_CASE("without noise the forces are found, and every sensor is explained", "[tpa]") {
  const PathProblem problem(1);
  const PathContributions found = problem.solved();
  CHECK((found.forces.values - problem.forces.values).norm() <
        1e-10 * problem.forces.values.norm());
  CHECK(found.validation.score() == Approx(1));
  for (Index line = 0; line < PathProblem::lines; ++line) {
    CHECK((found.synthesised(line) - found.measured_targets[line]).norm() < 1e-9);
  }
}

TEST_CASE("partial contributions are phasors whose sum is the target", "[tpa][law]") {
  PathProblem problem(2);
  // Two paths that cancel at the first target, wherever else they show.
  for (Index line = 0; line < PathProblem::lines; ++line) {
    problem.frfs.values[line](8, 1) = problem.frfs.values[line](8, 0);
    problem.forces[line].row(1) = -problem.forces[line].row(0);
    problem.forces[line].bottomRows(2).setZero();
  }
  problem.respond();
  const PathContributions found = problem.solved();
  for (Index line = 0; line < PathProblem::lines; ++line) {
    const Eigen::MatrixXcd partial = found.partial(line, 0);
    CHECK((partial.colwise().sum() - found.synthesised(line).row(0)).norm() < 1e-12);
    CHECK(partial.row(0).norm() > 0.1);
    CHECK(found.synthesised(line).row(0).norm() < 1e-9);
  }
}

TEST_CASE("forces are those of weighted least squares, by Eigen's QR", "[tpa]") {
  PathProblem problem(3);
  problem.add_sensor_noise(0.3, 8);
  Eigen::MatrixXcd all(PathProblem::indicators, PathProblem::lines * PathProblem::blocks);
  for (Index line = 0; line < PathProblem::lines; ++line) {
    problem.operating.values[line].row(2) *= 5;
    all.middleCols(line * PathProblem::blocks, PathProblem::blocks) =
        problem.operating.values[line].topRows(PathProblem::indicators);
  }
  const Eigen::VectorXd weights = all.rowwise().norm().cwiseInverse();
  const PathContributions found = problem.solved();
  for (Index line = 0; line < PathProblem::lines; ++line) {
    const Eigen::MatrixXcd frfs =
        weights.asDiagonal() * problem.frfs.values[line].topRows(PathProblem::indicators);
    const Eigen::MatrixXcd expected = algebra::least_squares(
        frfs,
        weights.asDiagonal() * problem.operating.values[line].topRows(PathProblem::indicators));
    CHECK((found.forces[line] - expected).norm() < 1e-10 * expected.norm());
  }
}

TEST_CASE("what noise adds to the forces is told by what no path explains", "[tpa]") {
  PathProblem problem(11);
  CHECK(problem.solved().force_noise.maxCoeff() < 1e-20);
  problem.add_sensor_noise(0.2, 12);
  const PathContributions found = problem.solved();
  const double error = (found.forces.values - problem.forces.values).squaredNorm();
  // 40 lines of 4 · 16 blocks outside: known to 3 %, and so is the error of as many forces.
  CHECK(found.force_noise.sum() * PathProblem::blocks == Approx(error).epsilon(0.12));
}

TEST_CASE("the score is the share of power that is explained", "[tpa]") {
  PathProblem problem(4);
  // Sensors for validation show a fourth of their amplitude from elsewhere.
  const Eigen::MatrixXcd other = test::complex_noise(2, PathProblem::blocks, 9);
  for (Index line = 0; line < PathProblem::lines; ++line) {
    auto rows = problem.operating.values[line].bottomRows(2);
    rows += 0.25 * rows.norm() / other.norm() * other;
  }
  const double score = problem.solved().validation.score();
  CHECK(score == Approx(1 - 0.0625 / 1.0625).margin(0.02));
  CHECK(problem.solved().validation.score({10, 12}) == Approx(score).margin(0.02));
  CHECK(std::isnan(problem.solved().validation.score({500, 600})));
}

TEST_CASE("sensors that show something else than the paths get no score", "[tpa][null]") {
  PathProblem problem(5);
  problem.operating.values.values =
      test::complex_noise(problem.operating.values.values.size(), 1, 77);
  CHECK(problem.solved().validation.score() < 0.1);
}

TEST_CASE("blocks in another order at the indicators explain nothing", "[tpa][null]") {
  PathProblem problem(6);
  for (Index line = 0; line < PathProblem::lines; ++line) {
    const Eigen::MatrixXcd rows = problem.operating.values[line].topRows(PathProblem::indicators);
    for (Index block = 0; block < PathProblem::blocks; ++block) {
      problem.operating.values[line].topRows(PathProblem::indicators).col(block) =
          rows.col((block + 3) % PathProblem::blocks);
    }
  }
  CHECK(problem.solved().validation.score() < 0);
}

TEST_CASE("silence has no forces", "[tpa][null]") {
  PathProblem problem(7);
  problem.operating.values.values.setZero();
  const PathContributions found = problem.solved();
  CHECK(found.forces.values.norm() == 0);
  CHECK(std::isnan(found.validation.score()));
}

TEST_CASE("lines that are left out have no forces and count in no score", "[tpa]") {
  PathProblem problem(8);
  problem.operating.values[5].setConstant(1000);
  std::vector<bool> is_used(PathProblem::lines, true);
  is_used[5] = false;
  const PathContributions found = matrix_inverse_contributions(
      problem.frfs, problem.operating, problem.roles, find_rule("none")->rule, is_used, 1);
  CHECK(found.forces[5].norm() == 0);
  CHECK(found.rules[5].kept == 0);
  CHECK(found.validation.score() == Approx(1));
  CHECK(problem.solved().validation.score() < 0.5);
}

TEST_CASE("every rule but one finds the forces of a sound problem to its noise", "[tpa]") {
  PathProblem problem(9);
  problem.add_sensor_noise(0.01, 5);
  problem.add_frf_errors(0.01, 6);
  for (const NamedRule& rule : regularisation_rules()) {
    // Its curve has no corner where nothing needs damping: see its limits.
    if (rule.name == "tikhonov_by_l_curve") continue;
    INFO(rule.name);
    const PathContributions found = problem.solved(std::string(rule.name));
    CHECK((found.forces.values - problem.forces.values).norm() <
          0.1 * problem.forces.values.norm());
    CHECK(found.validation.score() > 0.99);
  }
  CHECK(find_rule("tikhonov") == nullptr);
}

TEST_CASE("nothing is analysed without a sensor that it is not fitted to", "[tpa]") {
  const auto places = PathProblem::places;
  CHECK_THROWS_WITH(SensorRoles(places(0, 8), places(8, 10), {}),
                    Contains("no sensor is for validation"));
  CHECK_THROWS_WITH(SensorRoles(places(0, 8), places(8, 10), places(7, 8)),
                    Contains("C +Y is an indicator and cannot validate"));
  CHECK_THROWS_WITH(SensorRoles(places(0, 8), places(7, 10), places(10, 12)),
                    Contains("C +Y is both indicator and target"));
  CHECK_THROWS_WITH(SensorRoles({{"A", "+X"}, {"A", "X"}}, places(8, 10), places(10, 12)),
                    Contains("A +X is an indicator twice"));
  CHECK_NOTHROW(SensorRoles(places(0, 8), places(8, 10), places(9, 10)));
}

TEST_CASE("what does not go together is the caller's bug, and named", "[tpa]") {
  PathProblem problem(10);
  SECTION("other lines") {
    problem.operating.grid.first_Hz = 11;
    CHECK_THROWS_WITH(problem.solved(), Contains("not on the lines of the FRFs"));
  }
  SECTION("another unit") {
    problem.operating.unit = "g";
    CHECK_THROWS_WITH(problem.solved(), Contains("spectra in \"g\", FRFs in \"m/s²\""));
  }
  SECTION("a sensor that is not there") {
    problem.frfs.responses[0].point = "Z";
    CHECK_THROWS_WITH(problem.solved(), Contains("A +X is not there"));
  }
  SECTION("fewer indicators than paths") {
    problem.roles = {PathProblem::places(0, 3), PathProblem::places(8, 10),
                     PathProblem::places(10, 12)};
    CHECK_THROWS_WITH(problem.solved(), Contains("3 indicators for 4 paths"));
  }
}
