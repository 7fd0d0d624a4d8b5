#pragma once

#include <complex>
#include <vector>

#include "analysis/tpa/on_board_validation.hpp"
#include "analysis/tpa/sensor_roles.hpp"

namespace rvbench::analysis {

/// Between what does a mount sit, along one direction.
struct MountPlaces {
  DegreeOfFreedom active, passive;
};

/// What a mount is made of, along one direction.
struct MountParameters {
  double stiffness_N_m = 0, damping_N_s_m = 0, mass_kg = 0;
};

/// Force per relative acceleration [kg]: (k + iω·c - ω²·m) / -ω².
/// Errors  none thrown: not finite at 0 Hz. Source  definition
std::complex<double> dynamic_mass(const MountParameters& mount, double frequency_Hz);

/// Mounts as operation tells them, and the forces that they pass on.
struct ParametricMounts {
  std::vector<MountParameters> mounts;      ///< one per path
  std::vector<MountParameters> deviations;  ///< standard errors of each
  LineMatrices forces;                      ///< paths x blocks [N], on the passive side
  OnBoardValidation held_out;  ///< sensors fitted to, at every other line of the band: those that
                               ///< nothing was fitted to
};

/// Forces of mounts by their parameters, which a few sensors and operation give: no matrix of
/// indicators is needed.
///
///     F_p = (k_p + iω·c_p - ω²·m_p)·(x_active - x_passive),   A_r = Σ H_rp·F_p
///
/// least squares of all parameters over the first, third, ... line of the band, all blocks and
/// sensors, each sensor weighted by 1 / RMS. The lines between are the validity check.
///
/// @param frfs    of what carries the mounts, without the source: paths are the passive places
/// @param mounts  one per column of the FRFs
/// @param fitted   sensors, rows of the FRFs
/// @param is_used  one per line, empty for all: those left out count nowhere
/// Shape   lines of the FRFs; forces outside the band are 0
/// Units   FRFs in (m/s²)/N, spectra in m/s²
/// Errors  throws std::invalid_argument: other lines or units, a place that is not there, mounts
///         that are not the FRFs' columns, fewer than four lines in the band, a line at 0 Hz
/// Limits  one stiffness for all the band; directions of a mount that couple; a mount that does not
///         move has parameters 0
/// Source  Janssens, Gajdatsy, Gielen et al., Mech. Syst. Signal Process. 25(4), 1321-1338 (2011):
///         OPAX, its single degree of freedom model; the lines held out: ours
ParametricMounts parametric_mounts(const FrfMatrix& frfs, const OperatingSpectra& operating,
                                   const std::vector<MountPlaces>& mounts,
                                   const std::vector<DegreeOfFreedom>& fitted, const TpaBand& band,
                                   const std::vector<bool>& is_used = {});

}  // namespace rvbench::analysis
