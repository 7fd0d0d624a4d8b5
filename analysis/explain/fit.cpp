#include "analysis/explain/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/explain/covariance.hpp"
#include "analysis/explain/wave.hpp"
#include "hal/types/parallel_for.hpp"

namespace rvbench::analysis {
namespace {

constexpr int most_iterations = 30;       // of a fit, after the first moves
constexpr int most_refit_iterations = 8;  // from where a fit on nearly the same data ended
constexpr double least_same_cost = 1e-4;
constexpr double little_of_gain = 0.1;
constexpr double hardly_of_gain = 0.002;  // worth no step of a trial
constexpr double same_value = 0.05;
constexpr double same_angle_rad = 0.05;  // of a shape: 0 is no special angle
constexpr double same_in_errors = 0.1;   // of a standard error
constexpr double part_way_back = 0.25;
constexpr int most_ways_back = 3;           // each a quarter of the one before
constexpr int most_scatters = 4;            // tried in turn, each what the last fit left
constexpr double same_scatter = 0.9;        // of the one before
constexpr int opening_iterations = 2;       // of each start
constexpr int free_opening_iterations = 8;  // where all slopes are looked for anew
constexpr int middle_iterations = 4;        // of those that go on after that
constexpr std::size_t most_finalists = 3;   // starts that go on after that
constexpr double part_of_screened = 0.3;    // another start in the same valley, from the safe side
constexpr int sizes_tried = 7;              // of each start of a quick model,
constexpr double size_step = 0.316;         // one after the other

double gained_over(double before, double cost) {
  return before > cost ? std::log(before / cost) : 0;
}

// Costs that differ by less than one value's share in them are the same, or by little of what was
// gained over the cost before.
double same_cost(const FitProblem& on, const Descent& end, double before) {
  const double gained = gained_over(before, end.cost);
  const double one_share = 1 / std::max(1.0, values_learned(on));
  return std::max({least_same_cost, one_share, little_of_gain * gained});
}

std::size_t first_of_added(const FitProblem& on) {
  return first_value_of(on.model, on.effects, on.effects.empty() ? 0 : on.effects.size() - 1);
}

// Of the effect that was added, and not of phases: what else the two chose is no matter where it
// costs the same.
std::string disagreement(const FitProblem& on, const Descent& best, const Descent& other,
                         double before, const Eigen::MatrixXd& covariance = {}) {
  if (other.cost > best.cost * (1 + same_cost(on, best, before))) {
    return fmt::format("starts end at costs of {:.6g} and {:.6g}", best.cost, other.cost);
  }
  const std::vector<std::size_t> waves = waves_among(on.model, on.effects);
  const std::vector<double> here = as_waves(best.values, waves);
  const std::vector<double> there = as_waves(other.values, waves);
  const std::size_t first = first_of_added(on);
  const std::size_t first_shape =
      on.effects.empty() ? first : first + on.model.library()[on.effects.back()].sizes;
  for (std::size_t i = first; i < here.size(); ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    if (std::ranges::find(waves, i - 1) != waves.end()) continue;
    const double apart = std::abs(here[i] - there[i]);
    const bool is_angle = on.parameters[i].unit == "rad" && i >= first_shape;
    const double same = is_angle ? same_angle_rad : same_value * std::abs(here[i]);
    const double error =
        covariance.size() > 0 ? std::sqrt(std::max(covariance(index, index), 0.0)) : 0;
    if (apart > same && apart > same_in_errors * error) {
      return fmt::format("starts end at {} = {:.4g} and {:.4g} {}", on.parameters[i].name, here[i],
                         there[i], on.parameters[i].unit);
    }
  }
  return {};
}

// Whether two came to rest in the same place.
bool same_place(const FitProblem& on, const Descent& best, const Descent& other, double before) {
  return best.converged && other.converged && disagreement(on, best, other, before).empty();
}

std::string certificate(const FitProblem& on, const std::vector<Descent>& ends, double before,
                        const Eigen::MatrixXd& covariance) {
  if (!ends.front().converged) return "the fit did not converge";
  if (ends.size() < 2) return "there is only one start";
  std::string why;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    std::string apart = disagreement(on, ends.front(), ends[i], before, covariance);
    if (apart.empty()) return {};
    if (why.empty()) why = std::move(apart);
  }
  return why;
}

// The best after all starts have made a few moves, in order of their costs.
std::vector<Descent> first_moves(const FitProblem& on,
                                 const std::vector<std::vector<double>>& starts,
                                 const Eigen::MatrixXd& held) {
  std::vector<Descent> ends(starts.size());
  const int iterations = held.size() > 0 ? opening_iterations : free_opening_iterations;
  parallel_for(starts.size(),
               [&](std::size_t i) { ends[i] = descend(on, starts[i], iterations, held); });
  std::ranges::stable_sort(ends, {}, &Descent::cost);
  if (ends.size() > most_finalists) ends.resize(most_finalists);
  parallel_for(ends.size(), [&](std::size_t i) {
    if (!ends[i].converged) ends[i] = descend(on, ends[i].values, middle_iterations, held);
  });
  std::ranges::stable_sort(ends, {}, &Descent::cost);
  return ends;
}

// The others go where the first one did, in its own steps, unless they come to rest elsewhere.
// Where all of them do, as happens round a circle of phases, one that goes part of the way back
// toward the first start has to return.
void certify(const FitProblem& on, std::vector<Descent>& ends, const std::vector<double>& start,
             double before, double hardly) {
  for (std::size_t i = 1; i < ends.size(); ++i) {
    Descent& end = ends[i];
    end = descend(on, end.values, most_refit_iterations, ends.front().slopes, hardly);
    if (!same_place(on, ends.front(), end, before)) {
      end = descend(on, end.values, most_iterations, {}, hardly);
    }
    if (!end.converged || same_place(on, ends.front(), end, before)) break;
  }
  std::ranges::stable_sort(ends, {}, &Descent::cost);
  for (int tried = 0; tried < most_ways_back; ++tried) {
    if (ends.size() < 2 || same_place(on, ends[0], ends[1], before)) return;
    std::vector<double> back = ends.front().values;
    const double part = std::pow(part_way_back, tried + 1);
    for (std::size_t i = 0; i < back.size(); ++i) back[i] += part * (start[i] - back[i]);
    Descent end = descend(on, std::move(back), most_iterations, ends.front().slopes, hardly);
    if (!end.converged || end.cost > before) continue;
    ends.push_back(std::move(end));
    std::ranges::stable_sort(ends, {}, &Descent::cost);
  }
}

Fit given_up(const FitProblem& on, const Descent& end) {
  Fit none;
  none.effects = on.effects;
  none.values = end.values;
  none.cost = end.cost;
  none.scatter = on.scatter;
  none.not_certified = "explains too little";
  return none;
}

Fit fit_at(const FitProblem& on, const Descent& end, const Eigen::MatrixXd& held = {}) {
  Fit fit;
  fit.effects = on.effects;
  fit.values = end.values;
  fit.residuals = end.residuals;
  fit.slopes = end.slopes;
  fit.cost = end.cost;
  fit.scatter = on.scatter;
  if (fit.slopes.size() == 0) {
    const auto residuals = on.model.residuals(on.effects, fit.values, on.trained);
    const auto slopes = residuals ? jacobian(on, fit.values, *residuals, held) : std::nullopt;
    if (!slopes) {
      fit.not_certified = "the model cannot be evaluated where the fit ended";
      return fit;
    }
    fit.residuals = *residuals;
    fit.slopes = *slopes;
  }
  add_covariance(on, fit);
  return fit;
}

}  // namespace

std::size_t first_value_of(const ForwardModel& model, const std::vector<std::size_t>& effects,
                           std::size_t place) {
  std::size_t at = model.base().size();
  for (std::size_t i = 0; i < place; ++i) at += model.library()[effects[i]].parameters.size();
  return at;
}

Fit fit_from(const ForwardModel& model, const std::vector<std::size_t>& effects,
             std::vector<std::vector<double>> starts, const std::vector<bool>& trained,
             double scatter, const Eigen::MatrixXd& held, const MustBeat& must_beat) {
  const FitProblem on(model, effects, trained, scatter);
  for (std::vector<double>& start : starts) {
    for (std::size_t i = 0; i < start.size(); ++i) {
      start[i] = std::clamp(start[i], on.parameters[i].low, on.parameters[i].high);
    }
  }
  std::vector<Descent> ends = first_moves(on, starts, held);
  if (ends.front().cost > must_beat.after_first_moves) return given_up(on, ends.front());
  // Beside what else was left out the base goes a long way to little more.
  const double hardly = hardly_of_gain * gained_over(must_beat.before, ends.front().cost);
  ends.front() = descend(on, ends.front().values, most_iterations, held, hardly);
  if (ends.front().cost > must_beat.at_rest) return given_up(on, ends.front());
  if (ends.front().converged) certify(on, ends, starts.front(), must_beat.before, hardly);
  if (model.is_quick()) ends.front().slopes.resize(0, 0);  // what is left out is refitted by them
  Fit fit = fit_at(on, ends.front(), model.is_quick() ? Eigen::MatrixXd() : held);
  if (fit.not_certified.empty())
    fit.not_certified = certificate(on, ends, must_beat.before, fit.covariance);
  return fit;
}

std::vector<std::vector<double>> starts_from(const std::vector<double>& before,
                                             const std::vector<std::vector<double>>& all_own) {
  std::vector<std::vector<double>> starts;
  for (const std::vector<double>& own : all_own) {
    starts.push_back(before);
    starts.back().insert(starts.back().end(), own.begin(), own.end());
  }
  return starts;
}

namespace {

// Starts with their sizes as small as fits best while all else stays, the best few of them: from a
// size far off, a wave finds no way.
std::vector<std::vector<double>> scaled_down(const FitProblem& on,
                                             const std::vector<std::vector<double>>& starts,
                                             std::size_t first, std::size_t sizes) {
  std::vector<std::pair<double, std::vector<double>>> best;
  for (const std::vector<double>& start : starts) {
    std::pair<double, std::vector<double>> least{std::numeric_limits<double>::infinity(), start};
    double by = 1;
    for (int tried = 0; tried < sizes_tried; ++tried, by *= size_step) {
      std::vector<double> scaled = start;
      for (std::size_t i = first; i < first + sizes; ++i) scaled[i] *= by;
      const auto residuals = on.model.residuals(on.effects, scaled, on.trained);
      if (!residuals || !residuals->allFinite()) continue;
      const double cost = cost_of(on, scaled, *residuals);
      if (cost < least.first) least = {cost, std::move(scaled)};
    }
    best.push_back(std::move(least));
  }
  std::ranges::stable_sort(best, {}, &std::pair<double, std::vector<double>>::first);
  if (best.size() > most_finalists) best.resize(most_finalists);
  std::vector<std::vector<double>> scaled;
  for (auto& [cost, values] : best) scaled.push_back(std::move(values));
  return scaled;
}

}  // namespace

Fit fit_with(const ForwardModel& model, const Fit& before, std::size_t added,
             const std::vector<bool>& trained, const MustBeat& must_beat,
             const std::vector<double>& screened) {
  std::vector<std::size_t> effects = before.effects;
  effects.push_back(added);
  const Candidate& candidate = model.library().at(added);
  std::vector<std::vector<double>> all_own = candidate.starts;
  if (!screened.empty()) {
    if (candidate.has_far_starts) all_own.clear();
    all_own.push_back(screened);
    all_own.push_back(candidate.resized(screened, part_of_screened));
  }
  std::vector<std::vector<double>> starts = starts_from(before.values, all_own);
  if (model.is_quick() && candidate.when_small != Candidate::WhenSmall::structural) {
    const FitProblem on(model, effects, trained, before.scatter);
    starts = scaled_down(on, starts, before.values.size(), candidate.sizes);
  }
  // Far from where its slopes were found the base must be free to follow.
  const bool goes_far = candidate.has_far_starts && screened.empty();
  return fit_from(model, effects, std::move(starts), trained, before.scatter,
                  goes_far ? Eigen::MatrixXd() : before.slopes, must_beat);
}

Fit polish(const ForwardModel& model, const Fit& fit, const std::vector<bool>& trained,
           double before) {
  Fit polished = fit;
  const double hardly = hardly_of_gain * gained_over(before, fit.cost);
  double scatter = scatter_of(model, fit.residuals, trained);
  for (int round = 0; round < most_scatters; ++round) {
    const FitProblem on(model, fit.effects, trained, scatter);
    const Descent end = descend(on, polished.values, most_iterations, {}, hardly);
    polished = fit_at(on, end);
    if (!end.converged) polished.not_certified = "the fit did not converge";
    if (!polished.not_certified.empty()) return polished;
    scatter = scatter_of(model, polished.residuals, trained);
    if (scatter > same_scatter * polished.scatter) break;
  }
  polished.not_certified = fit.not_certified;
  return polished;
}

Evaluated foresee(const ForwardModel& model, const Fit& fit, const std::vector<bool>& trained) {
  if (model.is_quick()) return refit(model, fit, trained);
  return forecast(FitProblem(model, fit.effects, trained, fit.scatter), {fit.values, fit.residuals},
                  fit.slopes);
}

Evaluated refit(const ForwardModel& model, const Fit& fit, const std::vector<bool>& trained) {
  const FitProblem on(model, fit.effects, trained, fit.scatter);
  auto settled = settle(on, {fit.values, fit.residuals}, fit.slopes);
  if (settled) return std::move(*settled);
  const Descent end = descend(on, fit.values, most_refit_iterations, fit.slopes);
  if (end.residuals.size() > 0) return {end.values, end.residuals};
  auto residuals = model.residuals(fit.effects, end.values, trained);
  return {end.values, residuals ? std::move(*residuals) : Eigen::VectorXd()};
}

}  // namespace rvbench::analysis
