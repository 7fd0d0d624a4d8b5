#pragma once

#include "hal/types/embedded_file.hpp"

namespace rvbench::bench {

/// The files of bench/kinematics/.
const std::vector<EmbeddedFile>& kinematics_files();

}  // namespace rvbench::bench
