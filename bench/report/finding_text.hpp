#pragma once

#include <string>

#include "analysis/diagnosis.hpp"
#include "hal/types/outcome.hpp"

namespace rvbench::bench::report {

/// Where it lies among sound units of the same kind; empty if none were asked.
std::string sound_text(const analysis::Finding& finding);

/// "0.412 (0.398 to 0.431)": modulation depth and its 95 % interval, if it is known; and
/// "below 0.021" of what no point shows.
std::string severity_text(const analysis::Finding& finding);

/// "within its limit, 0.97 of it", "above its limit, 3.42 times it": the severity of a finding that
/// points show, so that its part is named and weighed in one breath.
std::string limit_text(const analysis::Finding& finding);

/// Whether the limit lies in the severity's interval: a finding that is above it, or within it, but
/// not surely.
bool is_close(const analysis::Finding& finding);

/// "seen, but the record is refused: clipped": how to tell what was found where findings_stand()
/// is false.
std::string seen_but(const Ending& ending);

/// "1.8e-05", of a p-value; "< 1e-15" of less, which no distribution is known well enough for.
std::string p_text(double p_value);

/// "its vibration goes as load^0.90 (± 0.10 at 95 %)": how it grows over the matrix, and whether
/// that is as the mechanism has it; empty if not known.
std::string growth_text(const analysis::Finding& finding);

/// "cannot be told from bearing_2: spall"; empty where the finding stands alone.
std::string rivals_text(const analysis::Finding& finding);

/// "may be a consequence of planet_gear: tooth_damage"; empty
/// where no graver finding has.
std::string cause_text(const analysis::Finding& finding);

/// What to do about a finding that stands: what it may follow from comes first.
std::string advice_text(const analysis::Finding& finding);

}  // namespace rvbench::bench::report
