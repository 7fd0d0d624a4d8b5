#include "analysis/explain/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/explain/covariance.hpp"
#include "analysis/explain/wave.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr double least_p = 0.01;
constexpr double at_bound = 1e-3;  // of the scale
constexpr double least_odds = 20;
constexpr double worth_going_on = 0.5;  // of the gain wanted, after the first moves of a fit

// The first parameter of the effect that ended at a bound, in words; empty if none did. That a size
// is small says nothing here: whether it is significant does. Nor does a shape's being none.
std::string bound_reached(const Fit& fit, const std::vector<ModelParameter>& parameters,
                          std::size_t first, const Candidate& effect) {
  for (std::size_t i = first; i < first + effect.parameters.size(); ++i) {
    const ModelParameter& p = parameters[i];
    const double near = at_bound * p.scale;
    const bool is_size = i < first + effect.sizes;
    const bool at_low = fit.values[i] < p.low + near && p.low != 0;
    const bool at_high = fit.values[i] > p.high - near && !(is_size && p.high == 0);
    if (at_low || at_high) {
      return fmt::format("{} ended at its bound, {:.4g} {}", p.name, fit.values[i], p.unit);
    }
  }
  return {};
}

// Of the sizes of an effect being nothing: the clearest one, for as many as there are; a wave has
// one. Its shape stays as it is: of what is nothing no shape is known, and a size that trades with
// a shape is not the less there.
double size_p_value(const Tryout& on, Fit fit, std::size_t first, const Candidate& effect,
                    const Fit& before) {
  const FitProblem problem(on.model, fit.effects, on.everything, fit.scatter);
  const auto shape = static_cast<Eigen::Index>(first + effect.sizes);
  const auto shapes = static_cast<Eigen::Index>(effect.parameters.size() - effect.sizes);
  fit.slopes.middleCols(shape, shapes).setZero();
  if (fit.slopes.cols() >= before.slopes.cols()) {
    fit.slopes.leftCols(before.slopes.cols()) = before.slopes;
    add_covariance(problem, fit);
  }
  const bool is_known = on.model.counts_standard_errors();
  const Eigen::VectorXd variances =
      is_known ? known_variances(problem, fit) : fit.covariance.diagonal();
  const double freedom = is_known ? values_learned(problem) : fit.freedom;
  const std::size_t sizes = effect.phasor ? 1 : effect.sizes;
  const std::vector<double> values = as_waves(fit.values, waves_among(on.model, fit.effects));
  double least = 1;
  for (std::size_t i = first; i < first + sizes; ++i) {
    const double error = std::sqrt(std::max(variances[static_cast<Eigen::Index>(i)], 0.0));
    if (error > 0) least = std::min(least, t_p_value(values[i] / error, freedom));
  }
  return std::min(1.0, least * static_cast<double>(sizes));
}

double independent_values(const Tryout& on) {
  double sum = 0;
  for (const ObservedUnit& unit : on.model.units()) {
    sum += std::max(static_cast<double>(unit.size) * on.counts_as, 1.0);
  }
  return sum;
}

// Of what is fitted: whether its predictions speak for it.
void judge_predictions(const Tryout& on, Trial& trial, const Standing& now,
                       const Standing& before) {
  trial.held_out = now.held_out;
  trial.extrapolated = now.extrapolated;
  trial.over_before = margin(now.held_out, before.held_out);
  if (margin(before.extrapolated, now.extrapolated).is_clear()) {
    trial.refused = "predicts left-out speeds or loads clearly worse";
    return;
  }
  trial.may_be = trial.over_before.delta >= on.least_gain();
  if (!trial.may_be || !foretells_more(on, now, before)) {
    trial.refused = "does not predict left-out conditions clearly better";
  }
}

// @return what would stand with it; nothing if that cannot be said
std::optional<Standing> judge(const Tryout& on, Trial& trial, const Standing& before,
                              LeftOut left_out) {
  const Standalone alone = stands_alone(on, trial.fit, trial.fit.effects.size() - 1, before.fit);
  trial.p_value = alone.p_value;
  trial.refused = alone.refused;
  if (!trial.refused.empty()) return std::nullopt;
  auto now = stand(on, trial.fit, left_out);
  if (now) {
    judge_predictions(on, trial, *now, before);
  } else {
    trial.refused = "the model cannot be evaluated without one of the conditions";
  }
  return now;
}

}  // namespace

bool foretells_more(const Tryout& on, const Standing& now, const Standing& before) {
  if (margin(now.held_out, before.held_out).is_clear()) return true;
  if (!on.model.counts_standard_errors()) return false;
  const Eigen::VectorXd apart = now.held_out.log_density - before.held_out.log_density;
  return apart.sum() - apart.maxCoeff() >= on.least_gain();
}

Standalone stands_alone(const Tryout& on, const Fit& fit, std::size_t place, const Fit& before) {
  const Candidate& effect = on.model.library()[fit.effects.at(place)];
  const std::size_t first = first_value_of(on.model, fit.effects, place);
  Standalone result;
  if (!fit.not_certified.empty()) {
    result.refused = "not fitted: " + fit.not_certified;
    return result;
  }
  result.p_value = std::min(1.0, size_p_value(on, fit, first, effect, before) *
                                     static_cast<double>(on.model.library().size()));
  if (result.p_value > least_p) {
    result.refused = "its size is not significant";
  } else {
    result.refused = bound_reached(fit, parameters_of(on.model, fit.effects), first, effect);
  }
  return result;
}

Tryout::Tryout(const ForwardModel& tried)
    : model(tried),
      conditions(condition_folds(tried.units())),
      extrapolations(extrapolation_folds(tried.units())),
      everything(tried.units().size(), true) {}

double Tryout::least_gain() const {
  return std::log(least_odds * static_cast<double>(model.library().size()));
}

double Tryout::gain_of(double share) const {
  return -0.5 * independent_values(*this) * std::log1p(-std::min(share, 1 - 1e-12));
}

double Tryout::cost_worth(double gain, double cost_before) const {
  double values = 0;
  for (const ObservedUnit& unit : model.units()) values += static_cast<double>(unit.size);
  const double scatter = std::max(cost_before, values * model.least_mean_square());
  return cost_before + scatter * std::expm1(-2 * gain / independent_values(*this));
}

std::optional<Standing> stand(const Tryout& on, Fit fit, LeftOut left_out) {
  auto held_out = predict_held_out(on.model, fit, on.conditions, on.counts_as, left_out);
  auto extrapolated = predict_held_out(on.model, fit, on.extrapolations, on.counts_as, left_out);
  if (!held_out || !extrapolated) return std::nullopt;
  return Standing{std::move(fit), std::move(*held_out), std::move(*extrapolated)};
}

MustBeat least_of(const Tryout& on, const Fit& before) {
  const double gain = on.least_gain();
  return {on.cost_worth(worth_going_on * gain, before.cost), on.cost_worth(gain, before.cost),
          before.cost};
}

Trial try_effect(const Tryout& on, const Standing& before, std::size_t effect,
                 const MustBeat& must_beat, const std::vector<double>& screened) {
  Trial trial;
  trial.fit = fit_with(on.model, before.fit, effect, on.everything, must_beat, screened);
  if (trial.fit.residuals.size() == 0) {
    trial.refused = trial.fit.not_certified;
    return trial;
  }
  if (trial.fit.cost > must_beat.at_rest) {
    trial.refused = trial.fit.not_certified = "explains too little";
    return trial;
  }
  judge(on, trial, before, LeftOut::forecast);
  return trial;
}

std::optional<Standing> confirm(const Tryout& on, const Standing& before, Trial& trial) {
  trial.fit = polish(on.model, trial.fit, on.everything, before.fit.cost);
  return judge(on, trial, before, LeftOut::refitted);
}

Step step_of(const Trial& confirmed, const Trial& best, const std::vector<Trial>& trials,
             double cost_before) {
  Step step;
  step.gain = std::log(cost_before / confirmed.fit.cost);
  step.effect = confirmed.effect();
  step.over_before = confirmed.over_before;
  step.error_after = confirmed.held_out.rms;
  step.p_value = confirmed.p_value;
  step.tried = trials;
  std::vector<HeldOut> ranked;
  for (const Trial& trial : trials) {
    const bool is_richer = trial.fit.values.size() > best.fit.values.size();
    if (!trial.may_be || (is_richer && margin(trial.held_out, best.held_out).is_clear())) continue;
    ranked.push_back(trial.held_out);
    const bool itself = trial.effect() == step.effect;
    const Margin apart = margin(best.held_out, trial.held_out);
    if (!itself && std::abs(apart.delta) <= 2 * apart.se) {
      step.equals.push_back(trial.effect());
    }
  }
  const std::vector<double> shares = shares_won(ranked);
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    if (ranked[i].effects.back() == step.effect) step.share_won = shares[i];
  }
  return step;
}

}  // namespace rvbench::analysis
