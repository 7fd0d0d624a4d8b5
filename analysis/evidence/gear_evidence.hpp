#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/diagnosis.hpp"
#include "analysis/evidence/own_lines.hpp"
#include "analysis/line_floor.hpp"
#include "analysis/order/order_lines.hpp"

namespace rvbench::analysis {

/// Where a record's gear lines are, for all of its channels that span the same turns.
struct GearPlaces {
  double resolution = 0;           ///< orders per line of the spectrum
  std::vector<PartLines> parts;    ///< one per signature
  std::vector<bool> locked;        ///< one flag per line: gears, shafts and pins may reach it
  std::vector<Eigen::Index> free;  ///< the other lines, ascending
  std::vector<Eigen::Index> free_before;  ///< of each line: how many free ones lie below it
};

/// Shape   as many lines as the spectrum of a channel has that spans so many turns, up to its top
///         order
/// @param is_placed  the speed is as good as measured; else lines beyond what it places are left
/// out
GearPlaces line_places(double turns, double top_order, double speed_Hz, bool is_placed,
                       const Kinematics& kinematics);

/// The same in the squared envelope of what is left without the gears' lines: where a part makes
/// noise that comes and goes with its turn. No two carriers beat there.
///
/// @param lines  of that envelope
GearPlaces envelope_places(const Kinematics& kinematics, double resolution, std::size_t lines);

/// What the own lines of one part hold in one channel.
struct GearReading {
  Eigen::VectorXd log_ratio;  ///< of each line against noise, whose mean is 1
  Eigen::MatrixXd decoys;     ///< lines x decoys: the same at lines that no gear reaches
  double own2 = 0;            ///< Σ squared amplitudes, without noise and without rivals
  double own2_variance = 0;   ///< by noise
  double mesh2 = 0;           ///< Σ squared amplitudes of its meshes' lines, without noise
  double mesh2_variance = 0;  ///< by noise
  Eigen::VectorXd line2;      ///< squared amplitude of each line, without noise
  double floor2 = 0;          ///< noise, the mean over its lines
  double floor_lines = 0;     ///< independent lines that it is worth at each
  double at_one2 = 0;         ///< Σ squared amplitudes that its lines would hold at severity 1
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

inline constexpr int gear_decoys = 48;

/// Scores shafts, gears and pins on one record: log ratios and decoys summed over its channels, the
/// severity as the median over them.
///
/// Shape   readings[c]: of channel c, one per part; empty where a channel is left out
/// Units   depths: amplitude of what damage does over the rms of the mesh, in the same channel; the
///         own lines hold their share of it
/// Source  p-values: decoy_p_value()
void score_gears(const std::vector<std::vector<GearReading>>& readings, const GearPlaces& places,
                 std::vector<SignatureScore>& scores);

/// The same of envelope_places(): a part that shows in the noise more than in its lines is judged
/// by the noise.
///
/// Units   depths: of the noise's amplitude, 1 = fully modulated
void score_noise(const std::vector<std::vector<GearReading>>& readings, const GearPlaces& places,
                 const Kinematics& kinematics, std::vector<SignatureScore>& scores);

}  // namespace rvbench::analysis
