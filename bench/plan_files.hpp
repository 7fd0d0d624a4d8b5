#pragma once

#include "hal/types/embedded_file.hpp"

namespace rvbench::bench {

/// The plans of sequences/plans, built in.
const std::vector<EmbeddedFile>& plan_files();

}  // namespace rvbench::bench
