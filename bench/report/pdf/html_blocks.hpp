#pragma once

#include <string_view>

#include "bench/report/pdf/block.hpp"
#include "bench/report/pdf/typesetter.hpp"

namespace rvbench::bench::pdf {

/// A section of the HTML report on paper: what the page says and the paper says is written once.
/// Headings, paragraphs, tables, lists of terms, texts as they are, and plots, two side by side;
/// other tags only part what is in them.
Blocks html_blocks(const Typesetter& typesetter, std::string_view html, double width_pt);

}  // namespace rvbench::bench::pdf
