#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/station/gage_study.hpp"
#include "bench/console.hpp"
#include "bench/station/gage_file.hpp"

namespace rvbench::bench {

/// What was studied, and what came of it.
struct GageAnswer {
  std::string file;
  GageFile data;
  analysis::GageStudy study;
  std::optional<double> tolerance;  ///< width between both limits, in the unit of the readings
  double confidence = 0.95;         ///< of the intervals
};

/// By the guideline of AIAG, Measurement Systems Analysis, 4th ed., ch. II: below 10 %, up to 30 %,
/// above; of the share of the total variation or of the tolerance, whichever is larger.
enum class GageWord { acceptable, conditional, not_acceptable };
GageWord word_of(const GageAnswer& answer);

std::string spoken_word(GageWord word);  ///< "MAY BE ACCEPTABLE"

std::string percent(double share);  ///< "12.3 %"

/// How much the gage makes up, how sure that is, and how many categories of parts it tells apart.
std::string gage_sentence(const GageAnswer& answer);

/// "10 parts x 3 operators x 3 trials, in mm; ..." and what became of the interaction.
std::string gage_reservation(const GageAnswer& answer);

/// EV, AV, INT (unless it is pooled), GRR, PV, each with its name.
std::vector<std::pair<std::string, analysis::GageComponent>> named_components(
    const analysis::GageStudy& study);

void print_gage(Console& console, const GageAnswer& answer);

}  // namespace rvbench::bench
