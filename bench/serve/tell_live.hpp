#pragma once

#include <string>

#include "bench/acceptance.hpp"
#include "bench/progress_bar.hpp"
#include "hal/rig.hpp"

namespace rvbench::bench {

/// From here on the run tells how it goes to this socket, which serve listens at. A run does not
/// end because nobody can be told: why not is a warning of the acceptance.
void tell_live(const std::string& socket, hal::Rig& rig, Acceptance& acceptance, ProgressBar& bar);

}  // namespace rvbench::bench
