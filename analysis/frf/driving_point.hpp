#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "analysis/frf/frf_band.hpp"
#include "hal/types/frequency_response.hpp"

namespace rvbench::analysis {

enum class DrivingPointWord {
  sound,     ///< takes up power, as a passive structure must
  reversed,  ///< gives power: hammer and sensor disagree in sign
  doubtful   ///< either, by turns: not the same place or axis
};

/// What a response at the place of its excitation says of itself.
struct DrivingPoint {
  DrivingPointWord word = DrivingPointWord::doubtful;
  double positive_share = 0;  ///< Σ of mobilities' real parts above 0, over Σ of their magnitudes
  std::vector<std::pair<double, double>> without_antiresonance;  ///< neighbouring modes, Hz
};

/// Checks a driving point: power flows into a passive structure, so that the real part of its
/// mobility (the imaginary part of its accelerance) is positive, which shows at the resonances;
/// and between two neighbouring resonances the imaginary part of the mobility rises through 0,
/// which makes an antiresonance.
///
/// Nine tenths of the real parts, by size, decide for sound or reversed.
///
/// @param resonances_Hz  in order, such as find_modes() tells; those outside of the band are not
///                       looked at
/// Shape   lines of the band; those at 0 Hz or not finite are left out
/// Units   of motion_of()
/// @return nothing if response and excitation are not on one axis of one point, the unit is no
///         motion's, or the band holds no line
/// Errors  none thrown
/// Source  Ewins, Modal Testing (2nd ed., 2000), sec. 2.7, 3.9; the share: ours
std::optional<DrivingPoint> check_driving_point(const FrequencyResponse& response,
                                                const FrfBand& band,
                                                const std::vector<double>& resonances_Hz);

}  // namespace rvbench::analysis
