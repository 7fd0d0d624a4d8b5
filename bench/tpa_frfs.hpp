#pragma once

#include <stop_token>
#include <string>
#include <variant>
#include <vector>

#include "analysis/frf/direction_doubts.hpp"
#include "analysis/tpa/coherent_lines.hpp"
#include "analysis/tpa/frf_draws.hpp"
#include "analysis/tpa/hammer_alignment.hpp"
#include "analysis/tpa/operating_spectra.hpp"
#include "bench/progress_bar.hpp"
#include "bench/tpa_project.hpp"

namespace rvbench::bench {

/// A hit that was not averaged over.
struct RejectedHit {
  std::string source;
  std::string reason;  ///< all that is wrong with it
};

/// The FRFs of a project, and how far they can be trusted.
struct TpaFrfs {
  analysis::FrfMatrix matrix;    ///< the project's sensors x its paths, lines of its bands
  analysis::FrfMatrix measured;  ///< the same before blows were set right: what is drawn from
  std::vector<analysis::ColumnDeviations> deviations;  ///< of hits; empty if there are none
  analysis::HammerAlignment alignment;                 ///< taken out of the matrix
  analysis::CoherentLines coherent;
  std::vector<analysis::DirectionDoubt> doubts;
  std::size_t hits = 0;  ///< of a hammer, that were read
  std::vector<RejectedHit> rejected;
};

/// Why data cannot be used, each with file or place.
using TpaRefusal = std::vector<std::string>;

/// Reads the FRFs, or makes them of the hits (H1, no exponential window: it would damp them). To a
/// method that needs none there are no FRFs, only their lines.
/// Refused: what a file is refused for; a sensor or path that is missing or there twice; a path
/// without one good hit; lines that do not reach over the bands.
/// @throws Interrupted
std::variant<TpaFrfs, TpaRefusal> read_tpa_frfs(const TpaProject& project, ProgressBar& bar,
                                                const std::stop_token& stop);

/// The lines of the FRFs. Units  Hz. Errors  none thrown. Source  definition
analysis::LineGrid grid_of(const analysis::FrfMatrix& matrix);

}  // namespace rvbench::bench
