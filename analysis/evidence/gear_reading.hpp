#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/evidence/gear_places.hpp"
#include "analysis/spectrum.hpp"

namespace rvbench::analysis {

/// Lines beside each own line, that no gear reaches: as many draws of noise.
inline constexpr int gear_decoys = 48;

/// What the own lines of one part hold in one channel.
struct GearReading {
  Eigen::VectorXd log_ratio;    ///< of each line against noise, whose mean is 1
  Eigen::MatrixXd decoys;       ///< lines x decoys: the same at lines that no gear reaches
  double own2 = 0;              ///< Σ squared amplitudes, without noise and without rivals
  double own2_variance = 0;     ///< by noise
  double mesh2 = 0;             ///< Σ squared amplitudes of its meshes' lines, without noise
  double mesh2_variance = 0;    ///< by noise
  Eigen::VectorXd line2;        ///< squared amplitude of each line, without noise
  double floor2 = 0;            ///< noise, the mean over its lines
  double floor_lines = 0;       ///< independent lines that it is worth at each
  double in_phase = not_known;  ///< blow_phases() of a part that strikes
  double at_one2 = 0;           ///< Σ squared amplitudes that its lines would hold at severity 1
};

/// Reads all parts off one channel. A line's power under a Hann window is that of three lines
/// over 1.5, wherever it lies between two.
///
/// Shape   one per part; that of a rolling element is empty
/// Units   squares of the channel's unit
/// Source  log_ratio: LineFloor::log_ratio()
std::vector<GearReading> read_gears(const Spectrum& spectrum, const GearPlaces& places);

/// The same of envelope_places(), off a squared envelope in depths.
std::vector<GearReading> read_noise(const Spectrum& depths, const GearPlaces& places);

}  // namespace rvbench::analysis
