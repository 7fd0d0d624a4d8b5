#include "analysis/tpa/operational_paths.hpp"

#include <catch2/catch.hpp>

#include "tests/analysis/tpa/path_problem.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using Eigen::Index;
using test::PathProblem;

namespace {

/// Two sensors near each of two sources, cross-talk between them, and what two targets make of the
/// references by known transmissibilities.
struct Operation {
  static constexpr Index references = 4, lines = 10, blocks = 24;
  LineMatrices transmissibilities{2, references, lines};
  OperatingSpectra learnt, held_out;

  explicit Operation(unsigned seed, double noise = 0) {
    transmissibilities.values = test::complex_noise(2 * references * lines, 1, seed);
    learnt = record(seed + 1, noise);
    held_out = record(seed + 2, noise);
  }

  OperatingSpectra record(unsigned seed, double noise) const {
    OperatingSpectra spectra{
        PathProblem::places(0, 6), "m/s²", {10, 0.5, lines}, {6, blocks, lines}};
    for (Index line = 0; line < lines; ++line) {
      const Eigen::MatrixXcd x =
          test::complex_noise(references, blocks, 100 * seed + unsigned(line));
      spectra.values[line].topRows(references) = x;
      spectra.values[line].bottomRows(2) = transmissibilities[line] * x;
    }
    spectra.values.values += noise * test::complex_noise(6 * blocks * lines, 1, seed + 999);
    return spectra;
  }

  OperationalPaths paths() const {
    return operational_paths(learnt, held_out, PathProblem::places(0, 4), PathProblem::places(4, 6),
                             find_rule("truncation_by_condition")->rule);
  }
};

}  // namespace

TEST_CASE("operation that varies enough tells what references hand on", "[tpa]") {
  const Operation operation(1);
  const OperationalPaths found = operation.paths();
  CHECK((found.transmissibilities.values - operation.transmissibilities.values).norm() < 1e-10);
  CHECK(found.held_out.score() == Approx(1));
  for (Index line = 0; line < Operation::lines; ++line) {
    CHECK(found.tells_all(line));
    CHECK((found.partial(line, 1).colwise().sum() - operation.learnt.values[line].row(5)).norm() <
          1e-10);
  }
}

TEST_CASE("noise at the sensors lowers the score by as much power", "[tpa]") {
  const double score = Operation(2, 0.1).paths().held_out.score();
  // A target holds 4 and 0.01 of noise; what references hold comes as much again, and fitting a
  // sixth: 1 - 0.01·(1 + 4)·(1 + 1/6)/4, nearly.
  CHECK(score == Approx(1 - 0.0146).margin(0.005));
}

TEST_CASE("references that always move together are not told apart", "[tpa]") {
  Operation operation(3);
  for (Index line = 0; line < Operation::lines; ++line) {
    operation.learnt.values[line].row(1) = 2 * operation.learnt.values[line].row(0);
    operation.learnt.values[line].bottomRows(2) =
        operation.transmissibilities[line] * operation.learnt.values[line].topRows(4);
  }
  const OperationalPaths found = operation.paths();
  for (Index line = 0; line < Operation::lines; ++line) {
    CHECK(found.rules[std::size_t(line)].kept == 3);
    CHECK_FALSE(found.tells_all(line));
  }
  // Other blocks do not keep to it, and show it.
  CHECK(found.held_out.score() < 0.9);
}

TEST_CASE("targets that references do not drive are not predicted", "[tpa][null]") {
  Operation operation(4);
  for (OperatingSpectra* spectra : {&operation.learnt, &operation.held_out}) {
    for (Index line = 0; line < Operation::lines; ++line) {
      spectra->values[line].bottomRows(2) = test::complex_noise(
          2, Operation::blocks, unsigned(line) + (spectra == &operation.learnt ? 7000 : 8000));
    }
  }
  CHECK(operation.paths().held_out.score() < 0);
  operation.learnt.values.values.setZero();
  const OperationalPaths silent = operation.paths();
  CHECK(silent.rules[0].kept == 0);
  CHECK(silent.held_out.score() == Approx(0));
}

TEST_CASE("an operational analysis names what does not go together", "[tpa]") {
  Operation operation(5);
  const auto analyse = [&](Index first_target, Index references) {
    return operational_paths(operation.learnt, operation.held_out,
                             PathProblem::places(0, references),
                             PathProblem::places(first_target, 6), find_rule("none")->rule);
  };
  CHECK_NOTHROW(analyse(4, 4));
  CHECK_THROWS_WITH(analyse(3, 4), Catch::Matchers::Contains("B is both reference and target"));
  operation.learnt.values = LineMatrices(6, 3, Operation::lines);
  CHECK_THROWS_WITH(analyse(4, 4), Catch::Matchers::Contains("3 blocks to learn from"));
  operation.held_out.grid.first_Hz = 11;
  CHECK_THROWS_WITH(analyse(4, 4), Catch::Matchers::Contains("differ in lines"));
}
