#pragma once

#include <string>
#include <vector>

#include "analysis/examples/example.hpp"

namespace rvbench::bench {

/// The essential lines of an example's source: those between each two lines "//! [page]", as far to
/// the left as they go together; an empty line between two stretches.
std::string shown_lines(const std::string& source);

/// One example as a page in Markdown: text, plot, lines, figures.
std::string page_of(const analysis::examples::Example& example, const std::string& source);

/// The page that leads to all of them.
std::string index_of(const std::vector<analysis::examples::Example>& examples);

}  // namespace rvbench::bench
