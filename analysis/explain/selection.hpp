#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analysis/explain/fit.hpp"
#include "analysis/explain/forward_model.hpp"
#include "analysis/explain/held_out.hpp"
#include "analysis/explain/screen.hpp"

namespace rvbench::analysis {

/// A candidate tried beside others, and how it did.
struct Trial {
  Fit fit;
  HeldOut held_out;  ///< forecast; of what was accepted, by refits
  HeldOut extrapolated;
  Margin over_before;   ///< over the model without it
  double p_value = 1;   ///< of its size, clustered by unit, times the number of candidates
  std::string refused;  ///< why it cannot be accepted; empty if it can
  bool may_be = false;  ///< it is accepted, or would be but for how its gain varies between units
  std::size_t effect() const { return fit.effects.back(); }
};

/// One effect accepted, and what else was tried in its place.
struct Step {
  std::size_t effect = 0;
  Margin over_before;
  double error_after = 0;  ///< root mean square of what was left out and predicted
  double p_value = 1;
  double gain = 0;       ///< log of the cost before over the cost after
  double share_won = 0;  ///< of bootstraps, against all others that may be it
  /// Those that may be it, and predict as well within 2 SE; not itself.
  std::vector<std::size_t> equals;
  std::vector<Trial> tried;  ///< all of them, best first
};

/// What was found to be left out.
struct Selection {
  Fit base;
  HeldOut base_held_out, base_extrapolated;
  std::vector<Step> steps;  ///< in the order in which they were accepted
  Fit fit;                  ///< with all of them
  HeldOut held_out, extrapolated;
  std::vector<Trial> last_tried;  ///< what did not pass any more, best first
  std::string miscalibrated;      ///< why the base cannot be trusted; empty if it can
};

struct SelectionOptions {
  std::size_t tries = 8;  ///< candidates fitted after each screening
  std::size_t most_effects = 6;
  /// Told the stage of the work, how much of it is done, 0 to 1, and what was done last; from any
  /// thread, also from two at once.
  /// May stop the work by throwing.
  std::function<void(const std::string& stage, double share, const std::string& doing)> progress =
      {};
};

/// Adds effects to the base as long as one predicts left-out conditions clearly better.
///
/// A candidate is accepted if its fit is certified, it predicts left-out conditions better by more
/// than two standard errors and at odds of 20 to 1 after the odds against any one of the library,
/// it does not predict left-out speeds and loads clearly worse, its size is significant (p times
/// the number of candidates below 0.01) and inside its bounds. One that does mostly what an
/// accepted effect does, and adds little to what that one gained, is no effect of its own. One that
/// needs more parameters than another that wins three quarters as much waits until that one is
/// accepted. Of those that are accepted and that none predicts clearly better, the one with the
/// fewest parameters is taken; those within two standard errors of it are its equals. Candidates
/// are ranked by what the slopes of their fits forecast for left-out conditions, those of a quick
/// model by refits; what is accepted is fitted anew without each of them. After each step earlier
/// ones are exchanged for their rivals where that predicts clearly better; where no single
/// candidate passes, the four most promising pairs are tried; in the end each effect that the
/// others made needless is dropped.
///
/// Units   log density in nats; errors as the model counts them
/// Errors  throws what options.progress throws; nothing else
/// Source  ours: forward selection by held-out log density, as predict_held_out() has it
Selection select_effects(const ForwardModel& model, const SelectionOptions& options = {});

}  // namespace rvbench::analysis
