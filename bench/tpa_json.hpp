#pragma once

#include <string>

#include "bench/tpa_study.hpp"

namespace rvbench::bench {

/// The document tpa.json: all of the study but the spectra. "leader" is null where none can be
/// told; values that are not known are null; levels are RMS in "unit".
std::string study_to_json(const TpaStudy& study);

}  // namespace rvbench::bench
