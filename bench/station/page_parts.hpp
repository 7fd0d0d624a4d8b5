#pragma once

#include <string>
#include <vector>

#include "bench/report/svg_plot.hpp"

namespace rvbench::bench {

/// One file without links to others: the style sheet of all reports, and this body.
std::string station_document(const std::string& title, const std::string& body);

/// The block on top: a word, what it means, and what it rests on.
/// @param style  "pass", "fail", or "" for what is neither
std::string word_block(const std::string& heading, const std::string& word,
                       const std::string& style, const std::string& sentence,
                       const std::string& reservation);

/// An axis with a little air around what it must hold; one of width where that is all one value.
PlotAxis axis_between(std::string label, double least, double greatest);

/// Plots side by side.
std::string figures(const std::vector<SvgPlot>& plots);

/// "value [mm]", or that the unit is not stated.
std::string value_label(const std::string& unit);

}  // namespace rvbench::bench
