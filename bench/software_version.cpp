#include "bench/software_version.hpp"

#include "bench/source_id.hpp"

namespace rvbench::bench {

std::string software_version() { return RVBENCH_VERSION " (" RVBENCH_SOURCE_ID ")"; }

}  // namespace rvbench::bench
