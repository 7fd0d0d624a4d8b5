#pragma once

#include <stop_token>
#include <string>
#include <variant>
#include <vector>

#include "bench/progress_bar.hpp"
#include "bench/tpa_frfs.hpp"

namespace rvbench::bench {

/// How hits at one place differ: hit_deviations() over the project's bands.
struct PlaceDeviations {
  DegreeOfFreedom excitation;
  std::vector<DegreeOfFreedom> responses;    ///< of the rows
  std::vector<Eigen::MatrixXcf> deviations;  ///< one per hit
};

/// What came of a hammer session.
struct MeasuredHits {
  std::vector<FrequencyResponse> responses;
  std::vector<PlaceDeviations> deviations;
  std::size_t hits = 0;
  std::vector<RejectedHit> rejected;
};

/// Reads the hits of a project, judges and averages them. Refused: a file that cannot be read, a
/// channel that is missing or there twice, a path without a good hit.
/// Units  SI, as the files. @throws Interrupted
std::variant<MeasuredHits, TpaRefusal> measure_hits(const TpaProject& project, ProgressBar& bar,
                                                    const std::stop_token& stop);

/// From the lowest band's first frequency to the highest one's last.
analysis::FrfBand whole_band(const TpaProject& project);

/// All sensors of a project, each once: indicators, targets, those for validation.
std::vector<DegreeOfFreedom> sensors_of(const TpaProject& project);

}  // namespace rvbench::bench
