#pragma once

#include <string>

namespace rvbench::bench {

/// "0.1.0 (a1b2c3d)": version and the commit it was built of; "-dirty" if sources were changed
/// since.
std::string software_version();

}  // namespace rvbench::bench
