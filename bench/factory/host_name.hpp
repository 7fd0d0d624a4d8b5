#pragma once

#include <string>

namespace rvbench::bench {

/// What this computer is called; "bench" if it has no name.
std::string host_name();

}  // namespace rvbench::bench
