#pragma once

#include <memory>

#include "hal/config_reader.hpp"
#include "sequences/phase.hpp"

namespace rvbench::sequences {

/// Turns the specimen under load for a time, so that grease and clearances are those of work: the
/// article's pre-rotation. Nothing is recorded.
std::unique_ptr<Phase> parse_warm_up(hal::ConfigReader& json);

}  // namespace rvbench::sequences
