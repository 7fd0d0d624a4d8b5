#include <fmt/format.h>

#include <algorithm>
#include <complex>
#include <cstddef>
#include <utility>

#include "analysis/frf/signed_axis.hpp"
#include "bench/tpa_methods.hpp"

namespace rvbench::bench {
namespace {

using Eigen::Index;

constexpr std::ptrdiff_t fewest_lines = 4;
constexpr double sure_deviations = 3;  // below nothing

// From the lowest band's first line to the highest one's last.
analysis::TpaBand whole_band(const analysis::LineGrid& grid) {
  return {grid.first_Hz, grid.frequency_Hz(grid.lines - 1)};
}

// Coherent, and in a band: what lies between bands is nobody's to fit.
std::vector<bool> used_lines(const TpaProject& project, const TpaFrfs& frfs) {
  std::vector<bool> is_used = frfs.coherent.is_used;
  const analysis::LineGrid grid = grid_of(frfs.matrix);
  for (Index line = 0; line < grid.lines; ++line) {
    const bool is_in_band = std::ranges::any_of(project.bands, [&](const analysis::TpaBand& band) {
      return analysis::holds(band, grid, line);
    });
    if (!is_in_band) is_used[std::size_t(line)] = false;
  }
  return is_used;
}

class ByMounts final : public TpaMethod {
 public:
  ByMounts(const TpaProject& project, const TpaFrfs& frfs, analysis::OperatingSpectra motion)
      : frfs_(frfs),
        motion_(std::move(motion)),
        roles_(project.indicators, project.targets, project.validation),
        is_used_(used_lines(project, frfs)) {
    for (std::size_t i = 0; i < project.active.size(); ++i) {
      mounts_.push_back({project.active[i], project.paths[i]});
    }
  }

  analysis::PathContributions contributions(const analysis::FrfMatrix& frfs,
                                            const std::vector<Index>& blocks,
                                            unsigned) const override {
    const analysis::OperatingSpectra some = blocks_of(motion_, blocks);
    analysis::ParametricMounts fit = fitted(frfs, some);
    analysis::LineMatrices forces = std::move(fit.forces);
    analysis::LineMatrices unused_sum(Index(roles_.validation().size()), some.values.columns,
                                      forces.lines);
    const analysis::LineMatrices to_unused = rows_of(frfs, roles_.validation()).values;
    for (Index line = 0; line < forces.lines; ++line) {
      if (!is_used_[std::size_t(line)]) forces[line].setZero();
      unused_sum[line] = to_unused[line] * forces[line];
    }
    const Index paths = forces.rows, lines = forces.lines;
    return {frfs.excitations,
            roles_.targets(),
            some.grid,
            std::move(forces),
            rows_of(frfs, roles_.targets()).values,
            rows_of(some, roles_.targets()).values,
            analysis::OnBoardValidation(rows_of(some, roles_.validation()), std::move(unused_sum),
                                        is_used_),
            {},
            {},
            is_used_,
            Eigen::MatrixXd::Zero(paths, lines),
            sides(),
            to_forces(fit.mounts, some.grid)};
  }

  MethodFindings findings(const analysis::PathContributions& whole) const override {
    const analysis::ParametricMounts fit = fitted(frfs_.matrix, motion_);
    MethodFindings found;
    found.mounts_score = fit.held_out.score();
    for (std::size_t i = 0; i < mounts_.size(); ++i) {
      found.mounts.push_back({mounts_[i].passive, fit.mounts[i], fit.deviations[i]});
      add_if_no_mount(found.mounts.back(), found.faults);
    }
    analysis::add_if_not_validated(whole.validation.score(), {}, found.faults);
    return found;
  }

 private:
  analysis::ParametricMounts fitted(const analysis::FrfMatrix& frfs,
                                    const analysis::OperatingSpectra& motion) const {
    return analysis::parametric_mounts(frfs, motion, mounts_, roles_.indicators(),
                                       whole_band(motion.grid), is_used_);
  }

  // Active sides, then passive ones.
  std::vector<DegreeOfFreedom> sides() const {
    std::vector<DegreeOfFreedom> places;
    for (const analysis::MountPlaces& mount : mounts_) places.push_back(mount.active);
    for (const analysis::MountPlaces& mount : mounts_) places.push_back(mount.passive);
    return places;
  }

  // Per acceleration of either side.
  analysis::LineMatrices to_forces(const std::vector<analysis::MountParameters>& found,
                                   const analysis::LineGrid& grid) const {
    const Index mounts = Index(found.size());
    analysis::LineMatrices per_side(mounts, 2 * mounts, grid.lines);
    for (Index line = 0; line < grid.lines; ++line) {
      if (!is_used_[std::size_t(line)]) continue;
      for (Index i = 0; i < mounts; ++i) {
        const std::complex<double> mass =
            analysis::dynamic_mass(found[std::size_t(i)], grid.frequency_Hz(line));
        per_side[line](i, i) = mass;
        per_side[line](i, mounts + i) = -mass;
      }
    }
    return per_side;
  }

  // No stiffness, damping or mass is below nothing.
  static void add_if_no_mount(const MountAnswer& mount, std::vector<analysis::TpaFault>& faults) {
    const auto is_below = [](double value, double deviation) {
      return value < -sure_deviations * deviation;
    };
    const auto& [found, deviations] = std::pair(mount.found, mount.deviations);
    std::string what;
    if (is_below(found.stiffness_N_m, deviations.stiffness_N_m)) what = "stiffness";
    if (is_below(found.damping_N_s_m, deviations.damping_N_s_m)) what = "damping";
    if (is_below(found.mass_kg, deviations.mass_kg)) what = "mass";
    if (what.empty()) return;
    faults.push_back({analysis::TpaFaultKind::no_mount, analysis::name_of(mount.path),
                      "its " + what +
                          " comes out negative: one stiffness, damping and mass do not hold over "
                          "the band, or something else acts"});
  }

  const TpaFrfs& frfs_;
  analysis::OperatingSpectra motion_;
  analysis::SensorRoles roles_;
  std::vector<bool> is_used_;
  std::vector<analysis::MountPlaces> mounts_;
};

void read_by_mounts(hal::ConfigReader& json, TpaProject& project) {
  project.active = read_places(json, "active");
  if (json.has("rule")) json.fault("rule", "mounts are fitted, not inverted: there is no rule");
  if (project.active.size() != project.paths.size()) {
    json.fault("active", fmt::format("{} places on the active side, for {} paths",
                                     project.active.size(), project.paths.size()));
  }
}

MadeTpaMethod make_by_mounts(const TpaProject& project, const TpaFrfs& frfs,
                             analysis::OperatingSpectra motion) {
  const analysis::FrfMatrix& matrix = frfs.matrix;
  if (matrix.response_unit != "m/s²" || matrix.excitation_unit != "N") {
    return "parameters of mounts need FRFs in (m/s²)/N, not in \"" + matrix.response_unit +
           "\" per \"" + matrix.excitation_unit + "\"";
  }
  if (!(motion.grid.first_Hz > 0)) return "a mount's stiffness cannot be told at 0 Hz";
  const auto lines = std::ranges::count(used_lines(project, frfs), true);
  if (lines < fewest_lines) {
    return fmt::format("{} coherent lines in the bands are too few for a mount", lines);
  }
  return std::make_unique<ByMounts>(project, frfs, std::move(motion));
}

}  // namespace

NamedTpaMethod mounts_method() {
  return {"parametric_mounts",
          "Forces are what mounts pass on, of the motion between both their sides and of one "
          "stiffness, damping and mass each, which are fitted to the indicators at every other "
          "line and held against the lines between.",
          true, read_by_mounts, make_by_mounts};
}

}  // namespace rvbench::bench
