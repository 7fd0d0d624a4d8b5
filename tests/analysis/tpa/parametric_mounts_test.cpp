#include "analysis/tpa/parametric_mounts.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "hal/types/linear_algebra.hpp"
#include "tests/analysis/tpa/coupled_masses.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using Eigen::Index;

namespace {

constexpr Index mounts = 3, carrying = 9, blocks = 8;

/// Three masses, each on a mount of its own on what carries them.
struct MountedMasses {
  Eigen::Vector3d stiffness_N_m{8e4, 3e4, 1.5e5}, damping_N_s_m{40, 15, 60};
  double stiffening = 0;  ///< of each mount over the band
  double force = 1;
  std::vector<MountPlaces> places;
  FrfMatrix frfs;  ///< of what carries alone
  OperatingSpectra operating;
  LineMatrices true_forces{mounts, blocks, test::coupled_grid().lines};

  MountedMasses()
      : frfs(test::frfs_between(test::numbered("C", 0, carrying), test::numbered("C", 0, mounts))) {
    for (Index i = 0; i < mounts; ++i) {
      places.push_back({test::numbered("A", i, i + 1)[0], test::numbered("C", i, i + 1)[0]});
    }
  }

  MountedMasses& run(unsigned seed) {
    const test::SpringBody carrier(carrying, seed);
    auto all = test::numbered("C", 0, carrying);
    for (const auto& place : test::numbered("A", 0, mounts)) all.push_back(place);
    const LineGrid& grid = test::coupled_grid();
    operating = {all, "m/s²", grid, LineMatrices(carrying + mounts, blocks, grid.lines)};
    for (Index line = 0; line < grid.lines; ++line) {
      const double omega = test::omega_of(line);
      const Eigen::MatrixXcd alone = carrier.dynamic_stiffness(omega);
      frfs.values[line] = -omega * omega * algebra::inverse_by_full_pivots(alone).leftCols(mounts);
      Eigen::MatrixXcd z = Eigen::MatrixXcd::Zero(carrying + mounts, carrying + mounts);
      z.topLeftCorner(carrying, carrying) = alone;
      for (Index i = 0; i < mounts; ++i) {
        const std::complex<double> k = mount(i, line), m = 2.0;
        const Index a = carrying + i;
        z(i, i) += k;
        z(i, a) -= k;
        z(a, i) -= k;
        z(a, a) += k - omega * omega * m;
      }
      Eigen::MatrixXcd push = Eigen::MatrixXcd::Zero(carrying + mounts, blocks);
      push.bottomRows(mounts) =
          force * test::complex_noise(mounts, blocks, seed + 1000 + unsigned(line));
      const Eigen::MatrixXcd x = algebra::ComplexLu(z).solve(push);
      operating.values[line] = -omega * omega * x;
      for (Index i = 0; i < mounts; ++i) {
        true_forces[line].row(i) = mount(i, line) * (x.row(carrying + i) - x.row(i));
      }
    }
    return *this;
  }

  MountedMasses& add_noise(double share, unsigned seed) {
    const auto size = operating.values.values.size();
    const double rms = operating.values.values.norm() / std::sqrt(double(size));
    operating.values.values += share * rms * test::complex_noise(size, 1, seed);
    return *this;
  }

  ParametricMounts found() const {
    return parametric_mounts(frfs, operating, places, test::numbered("C", 3, 8), {20, 49.5});
  }

 private:
  std::complex<double> mount(Index i, Index line) const {
    const double over = double(line) / double(test::coupled_grid().lines);
    return {stiffness_N_m[i] * (1 + stiffening * over), test::omega_of(line) * damping_N_s_m[i]};
  }
};

}  // namespace

TEST_CASE("stiffness and damping of mounts come out of operation", "[tpa]") {
  MountedMasses masses;
  const ParametricMounts found = masses.run(3).found();
  for (std::size_t i = 0; i < mounts; ++i) {
    CHECK(found.mounts[i].stiffness_N_m == Approx(masses.stiffness_N_m[Index(i)]).epsilon(1e-6));
    CHECK(found.mounts[i].damping_N_s_m == Approx(masses.damping_N_s_m[Index(i)]).epsilon(1e-5));
    CHECK(std::abs(found.mounts[i].mass_kg) < 1e-6);
  }
  CHECK(found.held_out.score() == Approx(1));
  CHECK((found.forces.values - masses.true_forces.values).norm() <
        1e-6 * masses.true_forces.values.norm());
}

TEST_CASE("noise moves parameters of mounts by about what their standard errors say", "[tpa]") {
  double squares = 0;
  int count = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    MountedMasses masses;
    const ParametricMounts found = masses.run(10 * seed).add_noise(0.003, seed).found();
    CHECK(found.held_out.score() > 0.9);
    for (std::size_t i = 0; i < mounts; ++i) {
      const double error = found.mounts[i].stiffness_N_m - masses.stiffness_N_m[Index(i)];
      squares += std::pow(error / found.deviations[i].stiffness_N_m, 2);
      ++count;
    }
  }
  // Of 24 squares of a standard normal deviate, the mean is 1 with a deviation of 0.3; noise of
  // what the mounts give way by pulls stiffness down besides, and lines are weighted alike.
  CHECK(squares / count > 0.2);
  CHECK(squares / count < 6);
}

TEST_CASE("a mount that has no one stiffness is betrayed by the lines held out", "[tpa]") {
  MountedMasses masses;
  masses.stiffening = 4;
  masses.damping_N_s_m *= 20;
  MountedMasses other;
  other.damping_N_s_m *= 20;
  // A mass may stand for a stiffness that falls with frequency; one that rises asks for a negative
  // one, and is no mount.
  const ParametricMounts found = masses.run(3).found();
  CHECK(other.run(3).found().held_out.score() > found.held_out.score());
  CHECK(found.mounts[0].mass_kg < 0);
}

TEST_CASE("the validity of mounts falls where FRFs are those of another machine", "[tpa]") {
  MountedMasses masses, other;
  masses.run(3);
  masses.frfs = other.run(4).frfs;
  CHECK(masses.found().held_out.score() < 0.6);
}

TEST_CASE("silence has no forces and no parameters", "[tpa][null]") {
  MountedMasses masses;
  masses.force = 0;
  const ParametricMounts found = masses.run(3).found();
  CHECK(found.forces.values.norm() == 0);
  CHECK(found.mounts[1].stiffness_N_m == 0);
  CHECK(std::isnan(found.held_out.score()));
}

TEST_CASE("mounts are refused what does not belong together", "[tpa]") {
  MountedMasses masses;
  masses.run(3);
  auto two = masses;
  two.places.pop_back();
  CHECK_THROWS_WITH(two.found(), Catch::Matchers::Contains("2 mounts for 3 paths"));
  auto exchanged = masses;
  std::swap(exchanged.places[0], exchanged.places[1]);
  CHECK_THROWS_WITH(exchanged.found(), Catch::Matchers::Contains("C1 +X is not path 1"));
  auto in_g = masses;
  in_g.operating.unit = "g";
  CHECK_THROWS_WITH(in_g.found(), Catch::Matchers::Contains("need m/s² and N"));
  CHECK_THROWS_WITH(parametric_mounts(masses.frfs, masses.operating, masses.places,
                                      test::numbered("C", 3, 8), {20, 21}),
                    Catch::Matchers::Contains("3 lines in the band"));
}
