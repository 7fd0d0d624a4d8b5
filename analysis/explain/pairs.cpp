#include "analysis/explain/pairs.hpp"

#include <algorithm>

namespace rvbench::analysis {
namespace {

constexpr std::size_t most_pairs = 4;
constexpr double worth_a_pair = 0.01;  // p of its scores, times the number of pairs

// Whether two, fitted at once, come to explain what one would have to.
bool may_gain_together(const Tryout& on, const Fit& before, const Pair& pair) {
  const auto& first = on.model.library()[pair.first].starts;
  const auto& second = on.model.library()[pair.second].starts;
  std::vector<std::vector<double>> own(std::max(first.size(), second.size()));
  for (std::size_t i = 0; i < own.size(); ++i) {
    own[i] = first[i % first.size()];
    const std::vector<double>& more = second[i % second.size()];
    own[i].insert(own[i].end(), more.begin(), more.end());
  }
  std::vector<std::size_t> effects = before.effects;
  effects.insert(effects.end(), {pair.first, pair.second});
  const Fit both = fit_from(on.model, effects, starts_from(before.values, own), on.everything,
                            before.scatter, before.slopes, least_of(on, before));
  return both.residuals.size() > 0;
}

}  // namespace

std::vector<Pair> promising_pairs(const Tryout& on, const std::vector<Screened>& screened) {
  std::vector<Pair> pairs;
  const std::size_t n = screened.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = i + 1; k < n; ++k) {
      const Screened &a = screened[i], &b = screened[k];
      if (!pair_is_admissible(on.model, a, b)) continue;
      const double p = pair_p_value(a, b) * double(n * (n - 1)) / 2;
      const double gain = on.gain_of(pair_explains(a, b));
      if (p < worth_a_pair && gain > on.least_gain()) pairs.push_back({a.effect, b.effect, gain});
    }
  }
  std::ranges::sort(pairs, std::ranges::greater{}, &Pair::gain);
  if (pairs.size() > most_pairs) pairs.resize(most_pairs);
  return pairs;
}

PairTrial try_pair(const Tryout& on, const Standing& before, const Pair& pair) {
  PairTrial trial;
  trial.second.refused = "its partner cannot be fitted";
  if (!may_gain_together(on, before.fit, pair)) return trial;
  trial.first.fit = fit_with(on.model, before.fit, pair.first, on.everything);
  if (!trial.first.fit.not_certified.empty()) return trial;
  const auto first = stand(on, trial.first.fit, LeftOut::forecast);
  if (!first) return trial;
  trial.first.held_out = first->held_out;
  trial.first.extrapolated = first->extrapolated;
  trial.first.over_before = margin(first->held_out, before.held_out);
  trial.second = try_effect(on, *first, pair.second, least_of(on, first->fit));
  if (!trial.second.refused.empty()) return trial;
  const Standalone partner =
      stands_alone(on, trial.second.fit, before.fit.effects.size(), before.fit);
  trial.first.p_value = partner.p_value;
  trial.second.refused = partner.refused;
  if (!margin(trial.second.held_out, before.held_out).is_clear()) {
    trial.second.refused = "the pair does not predict left-out conditions clearly better";
  }
  return trial;
}

}  // namespace rvbench::analysis
