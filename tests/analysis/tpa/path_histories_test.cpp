#include "analysis/tpa/path_histories.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "hal/types/units.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using Eigen::Index;

namespace {

constexpr double rate_Hz = 1000, step_Hz = 1;
const LineGrid grid{20, step_Hz, 181};  // to 200 Hz

/// Two forces from three sensors by constant gains, one of the sensors two milliseconds early, and
/// two targets that follow the forces by constant gains and three milliseconds later.
struct Machine {
  Eigen::MatrixXd to_forces{{2, 0, 1}, {0, -3, 0.5}}, to_targets{{1, 4}, {-2, 0.5}};
  PathContributions contributions{
      {{"P1", "+X"}, {"P2", "+X"}},
      {{"T1", "+X"}, {"T2", "+X"}},
      grid,
      LineMatrices(2, 1, grid.lines),
      LineMatrices(2, 2, grid.lines),
      LineMatrices(2, 1, grid.lines),
      OnBoardValidation({{{"V", "+X"}}, "m/s²", grid, LineMatrices(1, 1, grid.lines)},
                        LineMatrices(1, 1, grid.lines),
                        std::vector<bool>(std::size_t(grid.lines), true)),
      {},
      {},
      std::vector<bool>(std::size_t(grid.lines), true),
      Eigen::MatrixXd::Zero(2, grid.lines),
      {{"A", "+X"}, {"B", "+X"}, {"C", "+X"}},
      LineMatrices(2, 3, grid.lines)};

  Machine() {
    for (Index line = 0; line < grid.lines; ++line) {
      const double omega = units::two_pi * grid.frequency_Hz(line);
      contributions.to_forces[line] = to_forces.cast<std::complex<double>>();
      contributions.to_forces[line].col(1) *= std::polar(1.0, -0.002 * omega);
      contributions.target_frfs[line] =
          std::polar(1.0, -0.003 * omega) * to_targets.cast<std::complex<double>>();
    }
  }
};

// Tones inside the band, away from its edges; each sensor has its own.
double sensor(Index which, double t_s) {
  const double frequency_Hz[] = {37, 81.5, 120.25};
  return std::cos(units::two_pi * frequency_Hz[which] * t_s + double(which));
}

Eigen::MatrixXd recorded(Index samples) {
  Eigen::MatrixXd inputs(samples, 3);
  for (Index i = 0; i < samples; ++i) {
    for (Index which = 0; which < 3; ++which) inputs(i, which) = sensor(which, double(i) / rate_Hz);
  }
  return inputs;
}

}  // namespace

TEST_CASE("histories are what gains and delays make of tones, at their time", "[tpa]") {
  const Machine machine;
  const auto found = path_histories(machine.contributions, recorded(6000), rate_Hz);
  REQUIRE(found);
  CHECK(found->rate_Hz == rate_Hz);
  REQUIRE(found->forces.rows() == 6000);
  REQUIRE(found->contributions.size() == 2);
  // Past what filters of a second reach back to, twice, and as far from the end.
  for (Index i = 2000; i < 4500; i += 7) {
    const double t_s = double(i) / rate_Hz;
    const auto force_1 = [&](double at_s) { return 2 * sensor(0, at_s) + sensor(2, at_s); };
    const auto force_2 = [&](double at_s) {
      return -3 * sensor(1, at_s - 0.002) + 0.5 * sensor(2, at_s);
    };
    CHECK(found->forces(i, 0) == Approx(force_1(t_s)).margin(0.01));
    CHECK(found->forces(i, 1) == Approx(force_2(t_s)).margin(0.01));
    CHECK(found->contributions[0](i, 1) == Approx(4 * force_2(t_s - 0.003)).margin(0.05));
    CHECK(found->contributions[1](i, 0) == Approx(-2 * force_1(t_s - 0.003)).margin(0.05));
  }
}

TEST_CASE("histories hold nothing from outside the band, and nothing of silence", "[tpa][null]") {
  const Machine machine;
  Eigen::MatrixXd beyond(6000, 3);
  for (Index i = 0; i < beyond.rows(); ++i) {
    beyond.row(i).setConstant(std::cos(units::two_pi * 260 * double(i) / rate_Hz) + 5);
  }
  const auto outside = path_histories(machine.contributions, beyond, rate_Hz);
  REQUIRE(outside);
  CHECK(outside->forces.middleRows(2000, 2500).cwiseAbs().maxCoeff() < 0.02);
  const auto silent =
      path_histories(machine.contributions, Eigen::MatrixXd::Zero(3000, 3), rate_Hz);
  REQUIRE(silent);
  CHECK(silent->forces.isZero());
  CHECK(silent->contributions[1].isZero());
}

TEST_CASE("there are no histories at a rate that lines do not go with", "[tpa]") {
  const Machine machine;
  CHECK_FALSE(path_histories(machine.contributions, recorded(3000), 1000.5));
  CHECK_THROWS_AS(path_histories(machine.contributions, recorded(3000).leftCols(2), rate_Hz),
                  std::invalid_argument);
}

TEST_CASE("RMS over time is that of each stretch", "[tpa]") {
  Eigen::MatrixXd samples(6, 2);
  samples << 3, 1, 3, 1, 0, 1, 4, 1, 5, 1, 5, 1;
  const Eigen::MatrixXd rms = rms_over_time(samples, 3);
  REQUIRE(rms.rows() == 2);
  CHECK(rms(0, 0) == Approx(3));
  CHECK(rms(0, 1) == Approx(std::sqrt(8.0)));
  CHECK(rms(0, 2) == Approx(5));
  CHECK(rms.row(1).isOnes());
  CHECK_THROWS_AS(rms_over_time(samples, 7), std::invalid_argument);
}
