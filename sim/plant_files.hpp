#pragma once

#include "hal/types/embedded_file.hpp"

namespace rvbench::sim {

/// The files of sim/plants/.
const std::vector<EmbeddedFile>& plant_files();

}  // namespace rvbench::sim
