#include "analysis/explain/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr double least_p = 0.01;
constexpr double at_bound = 1e-3;  // of the range

// The first parameter of the effect that ended at a bound, in words; empty if none did. A size may
// end at zero: then it is not significant.
std::string bound_reached(const Fit& fit, const std::vector<ModelParameter>& parameters,
                          std::size_t first) {
  for (std::size_t i = first; i < parameters.size(); ++i) {
    const ModelParameter& p = parameters[i];
    const double margin = at_bound * (p.high - p.low);
    if (!std::isfinite(margin)) continue;
    if (fit.values[i] < p.low + margin || fit.values[i] > p.high - margin) {
      return fmt::format("{} ended at its bound, {:.4g} {}", p.name, fit.values[i], p.unit);
    }
  }
  return {};
}

// Of the size of the last effect, two-sided.
double size_p_value(const Tryout& on, const Fit& fit, std::size_t at) {
  const auto index = static_cast<Eigen::Index>(at);
  const double error = std::sqrt(std::max(fit.covariance(index, index), 0.0));
  if (!(error > 0)) return 1;
  const auto units = static_cast<double>(on.everything.size());
  const double freedom = std::max(units - static_cast<double>(fit.values.size()), 1.0);
  return t_p_value(fit.values[at] / error, freedom);
}

std::string refusal(const Trial& trial, const Standing& now, const Standing& before,
                    const std::vector<ModelParameter>& parameters, std::size_t first) {
  if (!trial.fit.not_certified.empty()) return "not fitted: " + trial.fit.not_certified;
  if (!trial.over_before.is_clear()) return "does not predict left-out conditions clearly better";
  if (now.extrapolated.log_density.sum() < before.extrapolated.log_density.sum()) {
    return "predicts left-out speeds or loads worse";
  }
  if (trial.p_value > least_p) return "its size is not significant";
  return bound_reached(trial.fit, parameters, first);
}

}  // namespace

Tryout::Tryout(const ForwardModel& tried)
    : model(tried),
      conditions(condition_folds(tried.units())),
      extrapolations(extrapolation_folds(tried.units())),
      everything(tried.units().size(), true) {}

std::optional<Standing> stand(const Tryout& on, Fit fit) {
  auto held_out = predict_held_out(on.model, fit, on.conditions, on.counts_as);
  auto extrapolated = predict_held_out(on.model, fit, on.extrapolations, on.counts_as);
  if (!held_out || !extrapolated) return std::nullopt;
  return Standing{std::move(fit), std::move(*held_out), std::move(*extrapolated)};
}

Trial try_effect(const Tryout& on, const Standing& before, std::size_t effect) {
  Trial trial;
  trial.fit = fit_with(on.model, before.fit, effect, on.everything);
  if (trial.fit.residuals.size() == 0) {
    trial.refused = trial.fit.not_certified;
    return trial;
  }
  const auto now = stand(on, trial.fit);
  if (!now) {
    trial.refused = "the model cannot be evaluated without one of the conditions";
    return trial;
  }
  trial.held_out = now->held_out;
  trial.extrapolated = now->extrapolated;
  trial.over_before = margin(now->held_out, before.held_out);
  const std::size_t first = before.fit.values.size();
  trial.p_value = std::min(
      1.0, size_p_value(on, trial.fit, first) * static_cast<double>(on.model.library().size()));
  trial.refused = refusal(trial, *now, before, parameters_of(on.model, trial.fit.effects), first);
  return trial;
}

}  // namespace rvbench::analysis
