#pragma once

#include "bench/serve/http.hpp"

namespace rvbench::bench {

/// A file of the operator page, built into the program; 404 if there is none of that path.
HttpAnswer page_file(const std::string& path);

}  // namespace rvbench::bench
