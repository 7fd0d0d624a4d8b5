#pragma once

#include "hal/types/embedded_file.hpp"

namespace rvbench::bench {

/// The files of the operator page, by their paths below bench/serve/page: "js/app.js".
const std::vector<EmbeddedFile>& page_files();

}  // namespace rvbench::bench
