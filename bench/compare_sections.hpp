#pragma once

#include <string>

#include "bench/compare_page.hpp"

/// Sections of compare.html. Each is HTML; empty if it has nothing to show.
namespace rvbench::bench::report {

/// Points by channels: the largest change of each, or that there is none, or that nobody can tell.
std::string compare_matrix_section(const analysis::Comparison& comparison);

/// Spectra before and after, side by side on one scale, of the points and channels where most
/// changed; of the first point where nothing did.
std::string compare_spectra_section(const analysis::Comparison& comparison,
                                    const CompareFacts& facts, const SpectrumLoader& spectra);

}  // namespace rvbench::bench::report
