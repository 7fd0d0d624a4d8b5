#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"
#include "analysis/evidence/gear_places.hpp"
#include "analysis/evidence/gear_reading.hpp"

namespace rvbench::analysis {

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
