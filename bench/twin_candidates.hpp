#pragma once

#include <map>
#include <string>

#include "analysis/explain/forward_model.hpp"
#include "sim/effect_sites.hpp"
#include "sim/plant_spec.hpp"
#include "sim/term_library.hpp"

namespace rvbench::bench {

/// What is much and what is little on a machine, for parameters whose own value does not tell.
struct ParameterScales {
  sim::NaturalScales natural;  ///< of one body
  double sample_s = 0;
  double deviation = 0;  ///< of what was measured, in its unit
  /// Frequencies that can be told of what keeps its own time; empty: they are fitted.
  std::vector<double> rhythms_Hz = {};
  /// Of bodies that turn together, while that one makes one turn; in order of the plant's; empty:
  /// all of them go as it does.
  std::vector<double> turns = {};
  bool fits_rhythms = false;  ///< besides rhythms_Hz, which are too far away for a fit
  /// Where a resonance would show; empty: the natural scale tells.
  std::vector<double> lines_Hz = {};
};

/// A quantity of the plant as a fit moves it: within its tolerance, within what the term's card
/// says of it; a free delay within two samples.
analysis::ModelParameter model_parameter(const sim::PlantSpec& plant,
                                         const sim::PlacedQuantity& placed,
                                         const ParameterScales& scales,
                                         const sim::TermLibrary& terms);

/// An effect at one place, as analysis tries it.
struct TwinCandidate {
  analysis::Candidate candidate;         ///< without parameters if there is nothing to fit
  std::map<std::string, double> chosen;  ///< parameters that are not fitted
};

/// One candidate; of an effect that keeps its own time, one for each of the scales' rhythms; of one
/// with a choice, one for each.
std::vector<TwinCandidate> candidates_at(const sim::PlantSpec& plant, const sim::TermType& type,
                                         const sim::EffectSite& site,
                                         const ParameterScales& scales);

}  // namespace rvbench::bench
