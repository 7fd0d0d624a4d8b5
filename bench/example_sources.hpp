#pragma once

#include "hal/types/embedded_file.hpp"

namespace rvbench::bench {

/// The sources of analysis/examples, built in: pages show the lines that were run.
const std::vector<EmbeddedFile>& example_sources();

}  // namespace rvbench::bench
