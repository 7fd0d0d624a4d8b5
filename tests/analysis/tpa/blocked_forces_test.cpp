#include "analysis/tpa/blocked_forces.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "hal/types/linear_algebra.hpp"
#include "tests/analysis/tpa/coupled_masses.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using Eigen::Index;

namespace {

constexpr Index interface = 2, inside = 3, carrying = 16, blocks = 6;

/// A source of two interface coordinates and three inside it, welded to one of sixteen coordinates
/// that carries it. Coordinates: the carrying ones, the first two of them the interface; then those
/// inside the source.
struct Assembly {
  test::SpringBody source{interface + inside, 1};
  test::SpringBody carrier;
  LineMatrices internal{inside, blocks, test::coupled_grid().lines};
  FrfMatrix frfs;
  OperatingSpectra operating;

  explicit Assembly(unsigned carrier_seed, double force = 1)
      : carrier(carrying, carrier_seed),
        frfs(test::frfs_between(places(), test::numbered("C", 0, interface))) {
    internal.values = force * test::complex_noise(internal.values.size(), 1, 77);
    operating = {places(), "m/s²", test::coupled_grid(),
                 LineMatrices(carrying + inside, blocks, test::coupled_grid().lines)};
    for (Index line = 0; line < test::coupled_grid().lines; ++line) {
      const double omega = test::omega_of(line);
      Eigen::MatrixXcd z = Eigen::MatrixXcd::Zero(carrying + inside, carrying + inside);
      z.topLeftCorner(carrying, carrying) = carrier.dynamic_stiffness(omega);
      const auto own = coordinates();
      z(own, own) += source.dynamic_stiffness(omega);
      const Eigen::MatrixXcd accelerance = -omega * omega * algebra::inverse_by_full_pivots(z);
      frfs.values[line] = accelerance.leftCols(interface);
      operating.values[line] = accelerance.rightCols(inside) * internal[line];
    }
  }

  static std::vector<DegreeOfFreedom> places() {
    auto all = test::numbered("C", 0, carrying);
    for (const auto& place : test::numbered("S", 0, inside)) all.push_back(place);
    return all;
  }

  // Of the source, among all.
  static std::vector<Index> coordinates() { return {0, 1, carrying, carrying + 1, carrying + 2}; }

  /// What the source pushes with against an interface that is held: its own equations alone.
  LineMatrices held() const {
    LineMatrices forces(interface, blocks, internal.lines);
    for (Index line = 0; line < internal.lines; ++line) {
      const Eigen::MatrixXcd z = source.dynamic_stiffness(test::omega_of(line));
      forces[line] = -z.topRightCorner(interface, inside) *
                     algebra::inverse_by_full_pivots(z.bottomRightCorner(inside, inside)) *
                     internal[line];
    }
    return forces;
  }

  BlockedForces found(const char* rule = "none") const {
    return blocked_forces(frfs, operating, roles, {"S0", "S1", "S2"}, find_rule(rule)->rule, {}, 1);
  }

  SensorRoles roles{test::numbered("C", 2, 12), test::numbered("C", 12, 14),
                    test::numbered("C", 14, 16)};
};

double off(const LineMatrices& a, const LineMatrices& truth) {
  return (a.values - truth.values).norm() / truth.values.norm();
}

}  // namespace

TEST_CASE("blocked forces are what the source pushes with against a held interface", "[tpa]") {
  const Assembly assembly(5);
  const BlockedForces blocked = assembly.found();
  CHECK(off(blocked.contributions.forces, assembly.held()) < 1e-8);
  CHECK(blocked.contributions.validation.score() == Approx(1));
  CHECK(blocked.disagreement < 1e-12);
}

TEST_CASE("blocked forces stay the same when something else carries the source", "[tpa]") {
  const Assembly one(5), other(6);
  CHECK((one.operating.values.values - other.operating.values.values).norm() >
        0.3 * one.operating.values.values.norm());
  CHECK(off(one.found().contributions.forces, other.found().contributions.forces) < 1e-8);
}

TEST_CASE("blocked forces of noisy sensors are as far off as their halves tell", "[tpa]") {
  Assembly assembly(7);
  const LineMatrices truth = assembly.held();
  const double rms = assembly.operating.values.values.norm() /
                     std::sqrt(double(assembly.operating.values.values.size()));
  assembly.operating.values.values +=
      0.01 * rms * test::complex_noise(assembly.operating.values.values.size(), 1, 8);
  const BlockedForces blocked = assembly.found();
  const double error = off(blocked.contributions.forces, truth);
  CHECK(error < 0.1);
  // Each half has half of the sensors, and their errors are independent: 2·2·error² and more.
  CHECK(blocked.disagreement > 2 * error * error);
  CHECK(blocked.disagreement < 40 * error * error);
}

TEST_CASE("an interface that was not hit in all its directions is not blocked, and it shows",
          "[tpa]") {
  const auto hit_once = [](unsigned carrier_seed) {
    Assembly assembly(carrier_seed);
    assembly.frfs.excitations.pop_back();
    LineMatrices first(carrying + inside, 1, test::coupled_grid().lines);
    for (Index line = 0; line < first.lines; ++line) {
      first[line] = assembly.frfs.values[line].leftCols(1);
    }
    assembly.frfs.values = first;
    return assembly.found();
  };
  const BlockedForces one = hit_once(5), other = hit_once(6);
  // All of both is explained, and agreed on, where both directions were hit.
  CHECK(one.contributions.validation.score() < 0.99);
  CHECK(one.disagreement > 1e-3);
  CHECK(off(one.contributions.forces, other.contributions.forces) > 0.05);
}

TEST_CASE("a silent source pushes with nothing", "[tpa][null]") {
  const BlockedForces blocked = Assembly(5, 0).found("tikhonov_by_gcv");
  CHECK(blocked.contributions.forces.values.norm() == 0);
  CHECK(blocked.disagreement == 0);
}

TEST_CASE("blocked forces are refused from inside the source", "[tpa]") {
  Assembly assembly(5);
  const auto with = [&](const SensorRoles& roles, const std::vector<std::string>& source) {
    return blocked_forces(assembly.frfs, assembly.operating, roles, source, find_rule("none")->rule,
                          {}, 1);
  };
  CHECK_THROWS_AS(with(assembly.roles, {}), std::invalid_argument);
  const SensorRoles within{test::numbered("S", 0, 3), test::numbered("C", 8, 10),
                           test::numbered("C", 10, 12)};
  CHECK_THROWS_WITH(with(within, {"S0", "S1", "S2"}),
                    Catch::Matchers::Contains("S0 is inside the source"));
}

TEST_CASE("too few indicators for two halves leave their agreement unknown", "[tpa]") {
  Assembly assembly(5);
  assembly.roles = {test::numbered("C", 2, 5), test::numbered("C", 8, 10),
                    test::numbered("C", 10, 12)};
  CHECK(std::isnan(assembly.found().disagreement));
}
