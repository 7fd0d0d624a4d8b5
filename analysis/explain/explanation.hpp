#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/explain/estimate.hpp"
#include "analysis/explain/selection.hpp"

namespace rvbench::analysis {

/// What an explanation says: of the whole, and of each effect.
enum class ExplainVerdict {
  null,               ///< nothing is missing that these data could show
  named,              ///< one effect, and no other does as well
  one_of_class,       ///< one of several that the data cannot part
  none_of_the_above,  ///< something repeatable is missing, and nothing in the library is it
  miscalibrated,      ///< the base had to leave what is known of it
  not_resolvable      ///< the data are too short or too few to tell, or are of something else
};

const char* to_string(ExplainVerdict verdict) noexcept;  ///< "NULL", "NAMED", "CLASS", ...

/// What else could be meant, and by how much it predicts worse.
struct RivalEffect {
  std::string name;
  Margin behind;
  std::string where = {};
};

struct ExplainedEffect {
  ExplainVerdict verdict = ExplainVerdict::named;
  std::string name;
  std::string where;
  std::vector<std::string> one_of;  ///< with itself, where the verdict is one_of_class
  std::vector<Estimate> parameters;
  double error_before = 0;  ///< held out, relative, without it
  double error_after = 0;   ///< and with it, at the time it was accepted
  Margin over_before;
  double p_value = 1;
  double share_won = 0;
  std::vector<RivalEffect> rivals;  ///< at most three, nearest first
  std::string next_experiment;
};

/// How much of what is left a law of any shape could predict on left-out conditions.
struct Ceiling {
  bool known = false;  ///< false: the model does not say what a law might depend on
  double error = 0;    ///< held out, relative
  Margin over_model;   ///< over what the explanation predicts
};

/// What the same search finds between two records that repeat each other.
struct SelfNull {
  bool known = false;           ///< false: no records repeat each other
  std::vector<Estimate> found;  ///< what drifted, or what is found by chance; empty: NULL
  double error = 0;             ///< of one repeat as the model of the other, relative
};

/// Held-out error before and after; unknown: there are too few speeds, or loads, to leave any out.
struct LeftOutError {
  bool known = false;
  double before = 0, after = 0;
  /// What noise alone leaves there, the numbers being as open as the other records leave them;
  /// nothing where noise_floor() has nothing.
  std::optional<double> floor = {};
};

struct Explanation {
  ExplainVerdict verdict = ExplainVerdict::null;
  std::string reason;               ///< one sentence for people
  bool in_standard_errors = false;  ///< what errors count: see counts_standard_errors()
  std::vector<ExplainedEffect> effects;
  std::vector<Estimate> nuisances, base;
  double trained_before = 0, trained_after = 0;
  double held_out_before = 0, held_out_after = 0;  ///< likewise, on left-out conditions
  LeftOutError speeds_out, loads_out;              ///< whole ones left out
  Ceiling ceiling_before, ceiling_after;
  SelfNull self_null;
  std::vector<RivalEffect> cannot_exclude;  ///< tried last and refused, the nearest three
  Selection selection;
};

/// Held-out error that noise alone leaves: one repeat differs from another by √2 of it. Without
/// repeats, what a law of any shape leaves, or one standard error where these are counted; nothing
/// if neither is known.
/// Units   of the held-out error. Errors  none thrown. Source  ours
std::optional<double> noise_floor(const Explanation& explanation);

/// "1.2 σ" of one that counts standard errors; "2.6 %" of a relative one.
std::string error_text(double error, bool in_standard_errors);

/// Locates, names and sizes what a model leaves out of its recordings. Where the errors of the
/// measurement are not known, and names do less than half of what a law of any shape could, none is
/// told, and nothing is added to the model: so little may be a part of what has no name.
/// @throws what options.progress throws
/// Shape, units  one verdict of all units; errors of fits as `in_standard_errors` says
/// Source  ours: selection by held-out prediction, see select_effects() and predict_held_out()
Explanation explain(const ForwardModel& model, const SelectionOptions& options = {});

}  // namespace rvbench::analysis
