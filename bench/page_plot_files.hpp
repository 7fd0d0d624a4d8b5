#pragma once

#include "hal/types/embedded_file.hpp"

namespace rvbench::bench {

/// What the operator page's plots take from npm, "uplot.js" and "uplot.css"; none without npm.
const std::vector<EmbeddedFile>& page_plot_files();

}  // namespace rvbench::bench
