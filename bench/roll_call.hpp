#pragma once

#include <optional>

#include "hal/rig.hpp"
#include "hal/types/outcome.hpp"

namespace rvbench::bench {

/// Connects every device of a rig, those on lines of their own at the same time. If one does not
/// answer, all are told to stop, and nobody is to move anything: a sequence that began without it
/// would wait for a standstill that nobody can see.
///
/// Time  as long as the slowest device: about 4 s where nothing is there
/// @return which ones do not answer, and why; nothing if all do
std::optional<Ending> roll_call(hal::Rig& rig);

}  // namespace rvbench::bench
