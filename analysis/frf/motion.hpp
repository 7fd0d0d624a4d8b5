#pragma once

#include <optional>
#include <string_view>

#include "analysis/frf/frf_estimate.hpp"
#include "hal/types/frequency_response.hpp"

namespace rvbench::analysis {

/// What moves per unit of force: receptance, mobility, accelerance.
enum class Motion { displacement, velocity, acceleration };

/// Of "m", "m/s", "m/s²", "rad", "rad/s", "rad/s²"; nothing for another unit.
/// Units  none. Errors  none thrown. Source  definition
std::optional<Motion> motion_of(std::string_view unit);

/// The same response as another motion: a factor of jω for each derivative.
///
/// Shape   the same lines. At 0 Hz a derivative is 0; an integral is not known there: NaN, and a
///         note says so
/// Units   in and out by response_unit
/// @return nothing if the unit of the response is none of a motion
/// Errors  none thrown. Source  Ewins, Modal Testing (2nd ed., 2000), sec. 2.2
std::optional<FrequencyResponse> as_motion(const FrequencyResponse& response, Motion motion);

/// With the standard error in the new unit as well.
/// Shape, units, errors, source  of the other
std::optional<EstimatedResponse> as_motion(const EstimatedResponse& estimate, Motion motion);

}  // namespace rvbench::analysis
