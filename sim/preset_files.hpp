#pragma once

#include "hal/types/embedded_file.hpp"

namespace rvbench::sim {

/// The files of sim/presets/.
const std::vector<EmbeddedFile>& preset_files();

}  // namespace rvbench::sim
