#pragma once

#include <cstddef>
#include <vector>

#include "analysis/explain/forward_model.hpp"

namespace rvbench::analysis {

/// Of the values of a model with some effects: where the two parts of each phasor begin.
std::vector<std::size_t> waves_among(const ForwardModel& model,
                                     const std::vector<std::size_t>& effects);

/// The values, each wave as size and phase, rad, in place of its cosine and sine part.
std::vector<double> as_waves(std::vector<double> values, const std::vector<std::size_t>& waves);

/// The other way.
std::vector<double> from_waves(std::vector<double> values, const std::vector<std::size_t>& waves);

}  // namespace rvbench::analysis
