#include "analysis/tpa/parametric_mounts.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <utility>

#include "analysis/frf/signed_axis.hpp"
#include "hal/types/linear_algebra.hpp"
#include "hal/types/require.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;
using Complex = std::complex<double>;
constexpr Index per_mount = 3;  // stiffness, damping, mass

void require_alike(const FrfMatrix& frfs, const OperatingSpectra& operating,
                   const std::vector<MountPlaces>& mounts) {
  constexpr Require require{"parametric_mounts"};
  require(is_on_lines_of(operating, frfs), "the spectra are not on the lines of the FRFs");
  require(frfs.response_unit == "m/s²" && frfs.excitation_unit == "N" && operating.unit == "m/s²",
          "parameters of mounts need m/s² and N");
  require(Index(mounts.size()) == frfs.values.columns,
          std::to_string(mounts.size()) + " mounts for " + std::to_string(frfs.values.columns) +
              " paths");
  for (std::size_t i = 0; i < mounts.size(); ++i) {
    require(positive(mounts[i].passive) == frfs.excitations[i],
            name_of(mounts[i].passive) + " is not path " + std::to_string(i + 1));
  }
}

// What each mount gives way by, mounts x blocks [m].
LineMatrices gives_of(const OperatingSpectra& operating, const std::vector<MountPlaces>& mounts) {
  std::vector<DegreeOfFreedom> active, passive;
  for (const MountPlaces& mount : mounts) {
    active.push_back(mount.active);
    passive.push_back(mount.passive);
  }
  LineMatrices gives = rows_of(operating, active).values;
  gives.values -= rows_of(operating, passive).values.values;
  for (Index line = 0; line < gives.lines; ++line) {
    const double omega = units::two_pi * operating.grid.frequency_Hz(line);
    gives[line] /= -omega * omega;
  }
  return gives;
}

// Force per displacement of a unit of each parameter.
Eigen::Vector3cd stiffnesses(double omega) { return {1.0, Complex(0, omega), -omega * omega}; }

// Sums over all that is fitted to: KᵀK, Kᵀy, yᵀy, and how many real numbers y is.
struct NormalEquations {
  Eigen::MatrixXd square;
  Eigen::VectorXd right;
  double power = 0;
  Index count = 0;

  void add(const Eigen::MatrixXcd& columns, const Eigen::VectorXcd& values) {
    square += (columns.adjoint() * columns).real();
    right += (columns.adjoint() * values).real();
    power += values.squaredNorm();
    count += 2 * values.size();
  }
};

void add_line(const Eigen::MatrixXcd& frfs, const Eigen::MatrixXcd& gives,
              const Eigen::MatrixXcd& responses, double omega, NormalEquations& sums) {
  const Eigen::Vector3cd of = stiffnesses(omega);
  Eigen::MatrixXcd columns(frfs.rows(), per_mount * frfs.cols());
  for (Index block = 0; block < gives.cols(); ++block) {
    for (Index i = 0; i < columns.cols(); ++i) {
      const Index mount = i / per_mount;
      columns.col(i) = frfs.col(mount) * (of[i % per_mount] * gives(mount, block));
    }
    sums.add(columns, responses.col(block));
  }
}

struct Solution {
  Eigen::VectorXd parameters, deviations;
};

Solution solve(const NormalEquations& sums) {
  const Eigen::VectorXd sizes = sums.square.diagonal().cwiseSqrt();
  const Eigen::VectorXd scales = (sizes.array() > 0).select(sizes.cwiseInverse(), 0.0);
  const Eigen::MatrixXd scaled = scales.asDiagonal() * sums.square * scales.asDiagonal();
  const Eigen::MatrixXd inverse = algebra::MinimumNorm(scaled).pseudo_inverse();
  const Eigen::VectorXd x = scales.cwiseProduct(inverse * scales.cwiseProduct(sums.right));
  const double left_over =
      std::max(0.0, sums.power - 2 * x.dot(sums.right) + x.dot(sums.square * x));
  const double freedom = double(std::max<Index>(sums.count - x.size(), 1));
  return {
      x, scales.cwiseProduct((inverse.diagonal().cwiseMax(0) * (left_over / freedom)).cwiseSqrt())};
}

std::vector<MountParameters> by_mount(const Eigen::VectorXd& values) {
  std::vector<MountParameters> mounts;
  for (Index i = 0; i < values.size(); i += per_mount) {
    mounts.push_back({values[i], values[i + 1], values[i + 2]});
  }
  return mounts;
}

// Lines of the band that are used: every other one is fitted to, from the first on.
struct FittedLines {
  std::vector<bool> is_fitted, is_held_out;
};

FittedLines lines_to_fit(const LineGrid& grid, const TpaBand& band,
                         const std::vector<bool>& is_used) {
  constexpr Require require{"parametric_mounts"};
  require(is_used.empty() || Index(is_used.size()) == grid.lines,
          std::to_string(is_used.size()) + " marks of lines that are used");
  const std::vector<bool> none(std::size_t(grid.lines), false);
  FittedLines lines{none, none};
  Index in_band = 0;
  for (Index line = 0; line < grid.lines; ++line) {
    const std::size_t i = std::size_t(line);
    if (!holds(band, grid, line) || (!is_used.empty() && !is_used[i])) continue;
    require(grid.frequency_Hz(line) > 0, "a mount has no stiffness at 0 Hz that could be told");
    (in_band++ % 2 == 1 ? lines.is_held_out : lines.is_fitted)[i] = true;
  }
  require(in_band >= 4, std::to_string(in_band) + " lines in the band");
  return lines;
}

Complex dynamic_stiffness(const MountParameters& mount, double omega) {
  const Eigen::Vector3cd of = stiffnesses(omega);
  return mount.stiffness_N_m * of[0] + mount.damping_N_s_m * of[1] + mount.mass_kg * of[2];
}

// Turns what the mounts give way by into what they pass on; 0 outside the band.
void make_forces(const std::vector<MountParameters>& mounts, const LineGrid& grid,
                 const TpaBand& band, LineMatrices& gives) {
  for (Index line = 0; line < grid.lines; ++line) {
    const double omega = units::two_pi * grid.frequency_Hz(line);
    for (Index i = 0; i < gives.rows; ++i) {
      gives[line].row(i) *=
          holds(band, grid, line) ? dynamic_stiffness(mounts[std::size_t(i)], omega) : 0.0;
    }
  }
}

}  // namespace

std::complex<double> dynamic_mass(const MountParameters& mount, double frequency_Hz) {
  const double omega = units::two_pi * frequency_Hz;
  return dynamic_stiffness(mount, omega) / (-omega * omega);
}

ParametricMounts parametric_mounts(const FrfMatrix& frfs, const OperatingSpectra& operating,
                                   const std::vector<MountPlaces>& mounts,
                                   const std::vector<DegreeOfFreedom>& fitted, const TpaBand& band,
                                   const std::vector<bool>& is_used) {
  require_alike(frfs, operating, mounts);
  const LineGrid& grid = operating.grid;
  FittedLines lines = lines_to_fit(grid, band, is_used);
  OperatingSpectra sensors = rows_of(operating, fitted);
  const LineMatrices to_sensors = rows_of(frfs, fitted).values;
  LineMatrices forces = gives_of(operating, mounts);
  const Eigen::VectorXd weights = inverse_rms(sensors.values);
  const Index unknowns = per_mount * Index(mounts.size());
  NormalEquations sums{Eigen::MatrixXd::Zero(unknowns, unknowns), Eigen::VectorXd::Zero(unknowns)};
  for (Index line = 0; line < grid.lines; ++line) {
    if (!lines.is_fitted[std::size_t(line)]) continue;
    add_line(weights.asDiagonal() * Eigen::MatrixXcd(to_sensors[line]), forces[line],
             weights.asDiagonal() * Eigen::MatrixXcd(sensors.values[line]),
             units::two_pi * grid.frequency_Hz(line), sums);
  }
  const Solution found = solve(sums);
  std::vector<MountParameters> parameters = by_mount(found.parameters);
  make_forces(parameters, grid, band, forces);
  LineMatrices synthesised(sensors.values.rows, sensors.values.columns, grid.lines);
  for (Index line = 0; line < grid.lines; ++line) {
    synthesised[line] = to_sensors[line] * forces[line];
  }
  return {
      std::move(parameters), by_mount(found.deviations), std::move(forces),
      OnBoardValidation(std::move(sensors), std::move(synthesised), std::move(lines.is_held_out))};
}

}  // namespace rvbench::analysis
