#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/explain/forward_model.hpp"
#include "bench/twin_candidates.hpp"
#include "sim/effect_sites.hpp"
#include "sim/plant_spec.hpp"
#include "sim/term_library.hpp"

namespace rvbench::bench {

/// A plant with what a fit may move of it and what it may lack: every type of the term library at
/// every place its gate allows.
class PlantFamily {
 public:
  /// @param library  outlives the family
  PlantFamily(sim::PlantSpec plant, const ParameterScales& scales, const sim::TermLibrary& library);

  /// Quantities that have a tolerance: it is two standard deviations wide.
  const std::vector<analysis::ModelParameter>& base() const { return base_; }
  const std::vector<analysis::Candidate>& candidates() const { return candidates_; }

  const sim::TermGate& gate_of(std::size_t candidate) const;
  const sim::EffectSite& site_of(std::size_t candidate) const { return acts_.at(candidate).second; }

  /// What it is tried at; empty if it has no frequency, or that is fitted.
  std::optional<double> chosen_frequency_Hz(std::size_t candidate) const;

  /// Data or comparison cannot show this candidate.
  void cannot_show(std::size_t candidate, std::string why) {
    candidates_.at(candidate).not_exercised = std::move(why);
  }

  /// In all that is compared, the one looks like the other: only the first is tried.
  void stands_for(std::size_t candidate, std::size_t other);

  /// Where it would show, the direction of motion never changes: see TermGate::one_way_like.
  void never_reverses(std::size_t candidate);

  /// The plant as it is, with one candidate of usual size.
  sim::PlantSpec with_usual(std::size_t candidate) const;

  /// @param effects  indices into candidates()
  /// @param values   of base(), then of each effect's parameters
  sim::PlantSpec with(const std::vector<std::size_t>& effects,
                      const std::vector<double>& values) const;

 private:
  void add_candidates(std::size_t type, const sim::EffectSite& site, const ParameterScales& scales);

  sim::PlantSpec plant_;
  const sim::TermLibrary& terms_;
  std::vector<std::size_t> moved_;  ///< of quantities(plant), those in base()
  std::vector<std::pair<std::size_t, sim::EffectSite>> acts_;  ///< per candidate: type and place
  std::vector<std::map<std::string, double>> chosen_;  ///< per candidate: what is not fitted
  std::vector<analysis::ModelParameter> base_;
  std::vector<analysis::Candidate> candidates_;
};

}  // namespace rvbench::bench
