#pragma once

#include <string>
#include <vector>

#include "analysis/explain/selection.hpp"

namespace rvbench::analysis {

/// What a selection tries things on: the model, and how it leaves conditions out.
///
/// Units   log density in nats; costs as the model counts residuals. Of all in this file:
/// Errors  none thrown: a model that cannot be evaluated is nothing, or a refusal with its reason
/// Source  ours; what each is made of names its own
struct Tryout {
  const ForwardModel& model;
  std::vector<Fold> conditions;
  std::vector<Fold> extrapolations;
  std::vector<bool> everything;  ///< per unit: true
  double counts_as = 1;          ///< what one value of the base's residuals is worth

  /// Log density that an effect must win on what was left out: odds of 20 to 1, after the odds
  /// against any one of the library.
  double least_gain() const;
  /// Log density won by explaining this share of what is left.
  double gain_of(double share) const;
  /// Cost below which a fit has won that on what it learned from.
  double cost_worth(double gain, double cost_before) const;

  explicit Tryout(const ForwardModel& model);
};

/// A fit with what is held out of it.
struct Standing {
  Fit fit;
  HeldOut held_out;
  HeldOut extrapolated;
};

/// @return nothing if the model cannot be evaluated in a fold
/// Units   log densities; residuals in noise's standard deviations. Errors  none thrown
/// Source  held_out(), of Stone, J. R. Stat. Soc. B 36(2), 111-147 (1974)
std::optional<Standing> stand(const Tryout& on, Fit fit, LeftOut left_out);

/// Whether left-out conditions are clearly better predicted. Where errors are those of the
/// measurement, an effect may show under one condition and not under others, which makes what it
/// wins scatter: then it may also be enough without the record that it wins most in, for one may be
/// odd.
/// Errors  none thrown. Source  ours, of paired log densities
bool foretells_more(const Tryout& on, const Standing& now, const Standing& before);

/// Whether a fit may be ranked, for one of its effects.
struct Standalone {
  double p_value = 1;   ///< of its size, times the number of candidates
  std::string refused;  ///< not certified, not significant, at a bound; empty if none of these
};

/// Whether its size may be nothing is asked with the slopes that `before` has without it: at its
/// own, numbers of the base scale its mark, and how large it is stays open where that it is there
/// does not.
/// @param place   of the effect in fit.effects
/// @param before  with the first effects of the fit, but not this one
/// Errors  none thrown. Source  Wald's test; Bonferroni's bound for the candidates
Standalone stands_alone(const Tryout& on, const Fit& fit, std::size_t place, const Fit& before);

/// What a fit must come below to win what an effect must, and half of it after its first moves.
/// Units   of the cost. Errors  none thrown. Source  ours
MustBeat least_of(const Tryout& on, const Fit& before);

/// Tries `effect` on top of what stands. Left-out conditions are forecast.
/// @param before    with forecasts, likewise
/// @param screened  one more start: see Screened; may be empty
/// Errors  none thrown: trial.refused says why it cannot be accepted. Source  ours
Trial try_effect(const Tryout& on, const Standing& before, std::size_t effect,
                 const MustBeat& must_beat, const std::vector<double>& screened = {});

/// Fits what was tried with all of its slopes, predicts left-out conditions by refits, and judges
/// it by them: trial.refused says why it cannot be accepted after all.
/// @param before  by refits, likewise
/// @return what would stand then; nothing if a fold cannot be evaluated
/// Errors  none thrown. Source  ours
std::optional<Standing> confirm(const Tryout& on, const Standing& before, Trial& trial);

/// What an accepted trial is beside the others.
/// @param best         as it was tried, among the others
/// @param cost_before  of the model without it
/// Errors  none thrown. Source  definition
Step step_of(const Trial& confirmed, const Trial& best, const std::vector<Trial>& trials,
             double cost_before);

}  // namespace rvbench::analysis
