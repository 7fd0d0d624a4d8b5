#pragma once

#include <functional>
#include <optional>
#include <string>

#include "analysis/compare/comparison.hpp"
#include "analysis/spectrum.hpp"
#include "bench/compare_json.hpp"

namespace rvbench::bench {

/// Order spectra of one channel at one point, before and after.
struct SpectrumPair {
  analysis::Spectrum a, b;
};

/// @return nothing if the records cannot be read again or are too short
using SpectrumLoader =
    std::function<std::optional<SpectrumPair>(std::size_t point, const std::string& channel)>;

/// The document compare.html, one file without links to others: what changed in a sentence, the
/// matrix of points and channels, each line and level that changed, spectra before and after where
/// most did, and what was not compared.
std::string make_compare_page(const analysis::Comparison& comparison, const CompareFacts& facts,
                              const SpectrumLoader& spectra);

}  // namespace rvbench::bench
