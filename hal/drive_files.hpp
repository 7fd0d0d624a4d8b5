#pragma once

#include "hal/types/embedded_file.hpp"

namespace rvbench::hal {

/// The files of hal/modbus/drives/.
const std::vector<EmbeddedFile>& drive_files();

}  // namespace rvbench::hal
