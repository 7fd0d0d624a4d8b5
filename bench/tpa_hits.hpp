#pragma once

#include <stop_token>
#include <string>
#include <variant>
#include <vector>

#include "bench/progress_bar.hpp"
#include "bench/tpa_frfs.hpp"

namespace rvbench::bench {

/// What came of a hammer session.
struct MeasuredHits {
  std::vector<FrequencyResponse> responses;
  std::size_t hits = 0;
  std::vector<RejectedHit> rejected;
};

/// Reads the hits of a project, judges and averages them. Refused: a file that cannot be read, a
/// channel that is missing or there twice, a path without a good hit.
/// Units  SI, as the files. @throws Interrupted
std::variant<MeasuredHits, TpaRefusal> measure_hits(const TpaProject& project, ProgressBar& bar,
                                                    const std::stop_token& stop);

/// All sensors of a project, each once: indicators, targets, those for validation.
std::vector<DegreeOfFreedom> sensors_of(const TpaProject& project);

}  // namespace rvbench::bench
