#include "analysis/explain/explanation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/explain/ceiling.hpp"
#include "analysis/explain/repeat_against_repeat.hpp"
#include "analysis/explain/trial.hpp"

namespace rvbench::analysis {
namespace {

constexpr std::size_t most_rivals = 3;
constexpr double beyond_errors = 1.2;  // of the measurement: what no noise leaves over
constexpr double far_off = 10;         // times what would be off if nothing were predicted
constexpr double worth_telling = 0.5;  // of what any law could explain: less is no answer

std::vector<RivalEffect> rivals_of(const ForwardModel& model, const Step& step) {
  std::vector<RivalEffect> rivals;
  const auto own = std::ranges::find_if(
      step.tried, [&](const Trial& trial) { return trial.effect() == step.effect; });
  if (own == step.tried.end() || own->held_out.log_density.size() == 0) return rivals;
  for (const Trial& trial : step.tried) {
    if (trial.effect() == step.effect || trial.held_out.log_density.size() == 0) continue;
    if (rivals.size() == most_rivals) break;
    const Candidate& rival = model.library()[trial.effect()];
    rivals.push_back({rival.name, margin(own->held_out, trial.held_out), rival.where});
  }
  return rivals;
}

void add_once(std::vector<std::string>& all, const std::string& one) {
  if (std::ranges::find(all, one) == all.end()) all.push_back(one);
}

// One name at several places is a name; several names are a class.
void name_and_place(const ForwardModel& model, const Step& step, ExplainedEffect& effect) {
  std::vector<std::string> names, places;
  const auto add = [&](const Candidate& candidate) {
    add_once(names, candidate.name);
    if (candidate.name == effect.name) add_once(places, candidate.where);
    for (const Candidate::Alike& alike : candidate.alike) {
      add_once(names, alike.name);
      if (alike.name == effect.name) add_once(places, alike.where);
    }
  };
  add(model.library()[step.effect]);
  for (const std::size_t other : step.equals) add(model.library()[other]);
  effect.where = fmt::format("{}", fmt::join(places, " or "));
  if (names.size() < 2) return;
  effect.verdict = ExplainVerdict::one_of_class;
  effect.one_of = names;
}

// Where a law of any shape would still predict clearly better, no form is quite right. What falls
// behind the effect of a step by less than this may then be it as well.
std::vector<std::size_t> as_good_as_any_form(const Step& step, const Ceiling& ceiling,
                                             double error) {
  std::vector<std::size_t> equals = step.equals;
  const auto own = std::ranges::find(step.tried, step.effect, &Trial::effect);
  if (!ceiling.known || !ceiling.over_model.is_clear() || own == step.tried.end()) return equals;
  const double not_right = error * error - ceiling.error * ceiling.error;
  for (const Trial& trial : step.tried) {
    const bool is_held = std::ranges::find(equals, trial.effect()) != equals.end();
    if (!trial.may_be || is_held || trial.effect() == step.effect) continue;
    const bool is_richer = trial.fit.values.size() > own->fit.values.size();
    if (is_richer && margin(trial.held_out, own->held_out).is_clear()) continue;  // is tried beside
    const double behind = std::pow(trial.held_out.rms, 2) - std::pow(own->held_out.rms, 2);
    if (behind < not_right) equals.push_back(trial.effect());
  }
  return equals;
}

LeftOutError left_out_error(const Explanation& e, std::size_t first_fold, std::size_t folds) {
  if (folds == 0) return {};
  const Selection& found = e.selection;
  std::optional<double> floor = noise_floor(e);
  if (floor) *floor *= found.extrapolated.expected_of(first_fold, folds);
  return {true, found.base_extrapolated.rms_of(first_fold, folds),
          found.extrapolated.rms_of(first_fold, folds), floor};
}

ExplainedEffect explained(const ForwardModel& model, const Selection& found, const Step& step,
                          const std::vector<Estimate>& values, double error_before) {
  const Candidate& candidate = model.library()[step.effect];
  ExplainedEffect effect;
  effect.name = candidate.name;
  effect.next_experiment = candidate.experiment;
  name_and_place(model, step, effect);
  const auto& held = found.fit.effects;
  const auto place = std::ranges::find(held, step.effect) - held.begin();
  const std::size_t at = first_value_of(model, held, static_cast<std::size_t>(place));
  effect.parameters.assign(values.begin() + std::ptrdiff_t(at),
                           values.begin() + std::ptrdiff_t(at + candidate.parameters.size()));
  effect.error_before = error_before;
  effect.error_after = step.error_after;
  effect.over_before = step.over_before;
  effect.p_value = step.p_value;
  effect.share_won = step.share_won;
  effect.rivals = rivals_of(model, step);
  return effect;
}

std::string sentence(const Explanation& explanation) {
  switch (explanation.verdict) {
    case ExplainVerdict::null: return "nothing is missing that these recordings could show";
    case ExplainVerdict::miscalibrated: return explanation.selection.miscalibrated;
    case ExplainVerdict::none_of_the_above:
      if (explanation.effects.empty()) {
        return "something repeatable is missing, and no effect of the library is it";
      }
      break;
    default: break;
  }
  std::string text = explanation.verdict == ExplainVerdict::none_of_the_above
                         ? "most of what is missing is no effect of the library; a part is: "
                         : "left out: ";
  for (std::size_t i = 0; i < explanation.effects.size(); ++i) {
    const ExplainedEffect& effect = explanation.effects[i];
    text += fmt::format("{}{} ({})", i == 0 ? "" : ", then ",
                        effect.one_of.empty()
                            ? effect.name
                            : "one of " + fmt::format("{}", fmt::join(effect.one_of, ", ")),
                        effect.where);
  }
  return text + fmt::format("; held-out error {} -> {}",
                            error_text(explanation.held_out_before, explanation.in_standard_errors),
                            error_text(explanation.held_out_after, explanation.in_standard_errors));
}

double trained_error(const Fit& fit) {
  const auto n = static_cast<double>(fit.residuals.size());
  return n > 0 ? std::sqrt(fit.residuals.squaredNorm() / n) : 0;
}

// What should be left and is not: errors of the measurement, what repeats differ by, or what a law
// of any shape leaves.
struct LeftOver {
  double floor = 0;
  bool is_more = false;
};

LeftOver left_over(const Explanation& e) {
  if (e.in_standard_errors) return {1, e.trained_after > beyond_errors};
  const double floor = noise_floor(e).value_or(0);
  if (e.self_null.known) {
    return {floor, e.held_out_after > beyond_errors * floor};
  }
  return {floor, e.ceiling_after.known && e.ceiling_after.over_model.is_clear()};
}

// How much of what could be predicted the explanation does. 1 if nothing is left to predict.
double told_share(const Explanation& e) {
  const auto [floor, leaves_more] = left_over(e);
  const double any = e.held_out_before * e.held_out_before - floor * floor;
  if (!leaves_more || !(any > 0)) return 1;
  const double told = e.held_out_before * e.held_out_before - e.held_out_after * e.held_out_after;
  return told / any;
}

SelfNull self_null_of(const ForwardModel& model, const Fit& fit, const SelectionOptions& options) {
  const auto repeats = RepeatAgainstRepeat::make(model, fit);
  if (!repeats) return {};
  SelectionOptions own = options;
  if (options.progress) {
    own.progress = [&](const std::string&, double share, const std::string& doing) {
      options.progress("repeat against repeat", share, doing);
    };
  }
  const Selection found = select_effects(*repeats, own);
  return {true, found.steps.empty() ? std::vector<Estimate>() : estimates(*repeats, found.fit),
          found.base_held_out.rms};
}

// Why the recordings must be of another machine, other channels or in other units; empty if they
// need not: noise may be all that they show.
std::string of_something_else(const ForwardModel& model, const Selection& found) {
  if (model.counts_standard_errors() || found.held_out.rms < far_off * model.nothing_predicted())
    return {};
  return fmt::format(
      "the model is farther off than no model would be (held-out error {}): channels, units or "
      "the plant are not those of the recordings",
      error_text(found.held_out.rms, false));
}

void conclude(const ForwardModel& model, Explanation& e) {
  if (!e.selection.miscalibrated.empty()) {
    e.verdict = ExplainVerdict::miscalibrated;
  } else if (told_share(e) < worth_telling) {
    e.verdict = ExplainVerdict::none_of_the_above;
  } else if (e.effects.empty()) {
    e.verdict = ExplainVerdict::null;
  } else {
    e.verdict = e.effects.front().verdict;
  }
  for (const Trial& trial : e.selection.last_tried) {
    if (e.cannot_exclude.size() == most_rivals || trial.held_out.log_density.size() == 0) continue;
    const Candidate& other = model.library()[trial.effect()];
    e.cannot_exclude.push_back({other.name, trial.over_before, other.where});
  }
  e.reason = sentence(e);
}

}  // namespace

const char* to_string(ExplainVerdict verdict) noexcept {
  switch (verdict) {
    case ExplainVerdict::null: return "NULL";
    case ExplainVerdict::named: return "NAMED";
    case ExplainVerdict::one_of_class: return "CLASS";
    case ExplainVerdict::none_of_the_above: return "NONE_OF_THE_ABOVE";
    case ExplainVerdict::miscalibrated: return "MISCALIBRATED";
    case ExplainVerdict::not_resolvable: return "NOT_RESOLVABLE";
  }
  return "";
}

std::optional<double> noise_floor(const Explanation& explanation) {
  if (explanation.self_null.known) return explanation.self_null.error / std::numbers::sqrt2;
  if (explanation.ceiling_after.known) return explanation.ceiling_after.error;
  if (explanation.in_standard_errors) return 1;
  return std::nullopt;
}

std::string error_text(double error, bool in_standard_errors) {
  return in_standard_errors ? fmt::format("{:.3g} σ", error) : fmt::format("{:.3g} %", 100 * error);
}

namespace {

Explanation explanation_of(const ForwardModel& model, const SelectionOptions& options) {
  Explanation e;
  e.in_standard_errors = model.counts_standard_errors();
  Tryout on(model);
  if (on.conditions.empty() || model.units().size() < fewest_units) {
    e.verdict = ExplainVerdict::not_resolvable;
    e.reason =
        fmt::format("{} stretches under {} are too few to leave any out", model.units().size(),
                    on.conditions.empty() ? "one condition"
                                          : fmt::format("{} conditions", on.conditions.size()));
    return e;
  }
  e.selection = select_effects(model, options);
  const Selection& found = e.selection;
  e.trained_before = trained_error(found.base);
  e.trained_after = trained_error(found.fit);
  e.held_out_before = found.base_held_out.rms;
  e.held_out_after = found.held_out.rms;
  e.reason = of_something_else(model, found);
  if (!e.reason.empty()) {
    e.verdict = ExplainVerdict::not_resolvable;
    return e;
  }
  if (found.fit.residuals.size() > 0) {
    const std::vector<Estimate> values = estimates(model, found.fit);
    for (std::size_t i = 0; i < model.base().size(); ++i) {
      (model.base()[i].nuisance ? e.nuisances : e.base).push_back(values[i]);
    }
    double before = e.held_out_before;
    on.counts_as = independent_share(model, found.base.residuals);
    e.ceiling_before = flexible_ceiling(on, {found.base, found.base_held_out, {}});
    e.ceiling_after = flexible_ceiling(on, {found.fit, found.held_out, {}});
    for (Step step : found.steps) {
      step.equals = as_good_as_any_form(step, e.ceiling_after, found.held_out.rms);
      std::erase_if(step.equals, [&](std::size_t other) {
        return std::ranges::find(found.fit.effects, other) != found.fit.effects.end();
      });
      e.effects.push_back(explained(model, found, step, values, before));
      before = e.effects.back().error_after;
    }
    e.self_null = self_null_of(model, found.fit, options);
    const std::size_t speeds = speed_folds(model.units()).size();
    e.speeds_out = left_out_error(e, 0, speeds);
    e.loads_out = left_out_error(e, speeds, on.extrapolations.size() - speeds);
  }
  conclude(model, e);
  return e;
}

}  // namespace

Explanation explain(const ForwardModel& model, const SelectionOptions& options) {
  Explanation e = explanation_of(model, options);
  const bool is_crumb =
      !e.in_standard_errors && !e.effects.empty() && e.verdict == ExplainVerdict::none_of_the_above;
  if (!is_crumb) return e;
  SelectionOptions of_base = options;
  of_base.most_effects = 0;
  Explanation without = explanation_of(model, of_base);
  without.verdict = ExplainVerdict::none_of_the_above;
  without.reason = sentence(without);
  return without;
}

}  // namespace rvbench::analysis
