#pragma once

#include <memory>

#include "hal/config_reader.hpp"
#include "sequences/phase.hpp"

namespace rvbench::sequences {

/// The phase that an object of "setup" or "main" describes; nullptr after noting a fault if its
/// kind is not known.
std::unique_ptr<Phase> parse_phase(hal::ConfigReader& json);

}  // namespace rvbench::sequences
