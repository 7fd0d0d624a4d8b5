#pragma once

#include <memory>

#include "hal/config_reader.hpp"
#include "sequences/phase.hpp"

namespace rvbench::sequences {

/// Speeds x loads x repeats: each point settles, then is recorded for some turns of the output.
///
/// Order "nested" is the article's: at each speed all loads, and that as often as repeats says.
/// "randomised" shuffles all points by a seed, so that warming up cannot look like load.
std::unique_ptr<Phase> parse_matrix(hal::ConfigReader& json);

}  // namespace rvbench::sequences
