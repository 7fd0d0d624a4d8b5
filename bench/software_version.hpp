#pragma once

#include <string>

namespace rvbench::bench {

/// "0.1.0 (a1b2c3d)": version and the source it was configured from.
std::string software_version();

}  // namespace rvbench::bench
