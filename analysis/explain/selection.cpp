#include "analysis/explain/selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "analysis/explain/base_fit.hpp"
#include "analysis/explain/miscalibration.hpp"
#include "analysis/explain/pairs.hpp"
#include "analysis/explain/trial.hpp"
#include "hal/types/parallel_for.hpp"

namespace rvbench::analysis {
namespace {

constexpr double worth_a_fit = 0.1;     // p of a score: a fit asks for a hundredth of it, and less
constexpr double worth_trying = 0.1;    // of the gain wanted, as a small effect would bring it
constexpr std::size_t most_rivals = 4;  // of an effect: with itself
constexpr double most_of_the_way = 0.75;  // of a gain, in log cost, that first moves must make
constexpr double mostly = 0.5;            // of what a candidate does, done by an accepted effect
constexpr double little = 0.1;            // of what the accepted effect gained, in log cost
constexpr double nearly_as_much = 0.75;   // of the log density that the best candidate wins

bool predicts_better(const Trial& a, const Trial& b) {
  const auto sum = [](const Trial& t) {
    return t.held_out.log_density.size() > 0 ? t.held_out.log_density.sum()
                                             : -std::numeric_limits<double>::infinity();
  };
  return sum(a) > sum(b);
}

class Selector {
 public:
  Selector(const ForwardModel& model, const SelectionOptions& options)
      : on_(model), options_(options) {}

  Selection run() {
    Selection result;
    tell("base", 0, "calibrating");
    result.base = fit_base(on_.model, on_.everything);
    if (result.base.residuals.size() == 0) {
      result.miscalibrated = "the base cannot be evaluated: " + result.base.not_certified;
      return result;
    }
    on_.counts_as = independent_share(on_.model, result.base.residuals);
    auto base = stand(on_, result.base, LeftOut::refitted);
    if (!base) {
      result.miscalibrated = "the base cannot be evaluated without one of the conditions";
      return result;
    }
    result.base_held_out = base->held_out;
    result.base_extrapolated = base->extrapolated;
    go_on_from(std::move(*base));
    do {
      while (steps_.size() < options_.most_effects && advance()) exchange(steps_.size() - 1);
    } while (exchange(steps_.size()));
    drop_needless();
    if (!steps_.empty()) finish();
    result.steps = steps_;
    result.fit = now_.fit;
    result.held_out = now_.held_out;
    result.extrapolated = now_.extrapolated;
    result.last_tried = last_tried_;
    // What was left out may have pulled the base away: only what stays away is miscalibrated.
    result.miscalibrated = miscalibration(on_.model, now_.fit);
    return result;
  }

 private:
  void go_on_from(Standing standing) {
    now_ = std::move(standing);
    foreseen_ = foreseen(now_);
  }

  // The same with forecasts; of a quick model these are the refits that it has.
  Standing foreseen(const Standing& standing) const {
    return on_.model.is_quick() ? standing : *stand(on_, standing.fit, LeftOut::forecast);
  }

  void tell(const std::string& stage, double share, const std::string& doing) const {
    if (options_.progress) options_.progress(stage, share, doing);
  }

  // Accepts one more effect. @return false if there is none
  bool advance() {
    screened_ = screen(on_.model, now_.fit, on_.everything, marks_);
    if (screened_.size() > options_.tries) screened_.resize(options_.tries);
    std::vector<Trial> trials = try_all();
    std::ranges::sort(trials, predicts_better);
    refuse_refinements(trials);
    for (auto best = simplest_of_the_best(trials); best != trials.end();
         best = simplest_of_the_best(trials)) {
      Trial confirmed = *best;
      if (auto standing = confirm(on_, now_, confirmed); confirmed.refused.empty()) {
        steps_.push_back(step_of(confirmed, *best, trials, now_.fit.cost));
        go_on_from(std::move(*standing));
        return true;
      }
      best->refused = confirmed.refused;
    }
    last_tried_ = std::move(trials);
    return accept_pair();
  }

  // What does mostly what an accepted effect does already, and adds little to it, says that the
  // form of that one is not quite right. It stands alone now, but as no partner of another.
  void refuse_refinements(std::vector<Trial>& trials) {
    for (Trial& trial : trials) {
      if (!trial.refused.empty()) continue;
      const double gain = std::log(foreseen_.fit.cost / trial.fit.cost);
      const std::vector<double> done_by = done_by_others(on_.model, trial.fit);
      for (std::size_t e = 0; e < done_by.size() && trial.refused.empty(); ++e) {
        const auto step = std::ranges::find(steps_, trial.fit.effects[e], &Step::effect);
        if (done_by[e] < mostly || gain > little * step->gain) continue;
        trial.refused = "does little but refine " + on_.model.library()[step->effect].name;
        std::erase_if(screened_, [&](const Screened& s) { return s.effect == trial.effect(); });
      }
    }
  }

  // Of those that none beats clearly, the one with the fewest parameters; or one with fewer that
  // wins nearly as much: what the best one has beyond it can still be added, and where that is all
  // of it, the other turns out to be needless.
  std::vector<Trial>::iterator simplest_of_the_best(std::vector<Trial>& trials) const {
    const auto accepted = [](const Trial& t) { return t.refused.empty(); };
    const auto best = std::ranges::find_if(trials, accepted);
    auto simplest = best;
    for (auto t = best; t != trials.end(); ++t) {
      if (!accepted(*t) || t->fit.values.size() >= simplest->fit.values.size()) continue;
      const Margin behind = margin(best->held_out, t->held_out);
      const bool wins_nearly_as_much =
          t->over_before.delta > nearly_as_much * best->over_before.delta;
      if (!behind.is_clear() || (wins_nearly_as_much && behind.delta > on_.least_gain())) {
        simplest = t;
      }
    }
    return simplest;
  }

  std::vector<Trial> try_all() const {
    std::vector<Screened> worthy = screened_;
    std::erase_if(worthy, [&](const Screened& s) {
      const bool may_gain = on_.gain_of(s.explains) > worth_trying * on_.least_gain();
      return !s.is_admissible || s.p_value >= worth_a_fit || !may_gain;
    });
    const MustBeat least = least_of(on_, foreseen_.fit);
    std::vector<Trial> trials(worthy.size());
    std::atomic<std::size_t> done = 0;
    const std::string stage = fmt::format("effect {}", steps_.size() + 1);
    tell(stage, 0, "fitting candidates");
    parallel_for(worthy.size(), [&](std::size_t i) {
      const Screened& s = worthy[i];
      trials[i] = try_effect(on_, foreseen_, s.effect, least, s.start);
      tell(stage, double(++done) / double(worthy.size()),
           on_.model.library()[s.effect].name + " fitted");
    });
    return trials;
  }

  // Two effects together that neither shows alone.
  bool accept_pair() {
    if (steps_.size() + 2 > options_.most_effects) return false;
    const std::vector<Pair> pairs = promising_pairs(on_, screened_);
    std::vector<PairTrial> trials(pairs.size());
    std::atomic<std::size_t> done = 0;
    parallel_for(pairs.size(), [&](std::size_t i) {
      trials[i] = try_pair(on_, foreseen_, pairs[i]);
      tell(fmt::format("effect {}, pairs", steps_.size() + 1),
           double(++done) / double(pairs.size()), "fitting");
    });
    std::erase_if(trials, [](const PairTrial& t) { return !t.second.refused.empty(); });
    std::ranges::sort(trials, [](const PairTrial& a, const PairTrial& b) {
      return predicts_better(a.second, b.second);
    });
    for (const PairTrial& pair : trials) {
      if (confirm_pair(pair)) return true;
    }
    return false;
  }

  bool confirm_pair(PairTrial pair) {
    const Trial first_tried = pair.first, second_tried = pair.second;
    auto standing = confirm(on_, now_, pair.second);
    if (!pair.second.refused.empty()) return false;
    const std::size_t place = now_.fit.effects.size();
    if (!stands_alone(on_, pair.second.fit, place, now_.fit).refused.empty()) return false;
    const auto first =
        stand(on_, polish(on_.model, pair.first.fit, on_.everything), LeftOut::refitted);
    if (!first) return false;
    pair.first.held_out = first->held_out;
    pair.first.over_before = margin(first->held_out, now_.held_out);
    pair.second.over_before = margin(pair.second.held_out, first->held_out);
    std::erase_if(last_tried_, [&](const Trial& t) { return t.effect() == pair.first.effect(); });
    last_tried_.insert(last_tried_.begin(), first_tried);
    steps_.push_back(
        step_of(pair.first, first_tried, std::exchange(last_tried_, {}), now_.fit.cost));
    steps_.push_back(step_of(pair.second, second_tried, {second_tried}, first->fit.cost));
    go_on_from(std::move(*standing));
    return true;
  }

  // Exchanges the first effects for rivals that predict clearly better beside the others: in the
  // end the newest one, too, which may have been taken for being simple while more was to come.
  // Those that predict as well there are its equals then.
  // @return whether any was
  bool exchange(std::size_t first_effects) {
    bool any = false;
    for (std::size_t s = 0; s < first_effects; ++s) {
      const std::vector<std::size_t> rivals = rivals_of(s);
      if (rivals.empty()) continue;
      const auto rest = refit_without(steps_[s].effect);
      if (!rest) continue;
      for (const std::size_t rival : rivals) {
        const bool held = std::ranges::find(now_.fit.effects, rival) != now_.fit.effects.end();
        if (held) continue;
        const Beside beside = try_exchange(s, *rest, rival);
        any = any || beside == Beside::better;
        if (beside == Beside::better) break;  // the others were its rivals, not of this one
        std::erase(steps_[s].equals, rival);
        if (beside == Beside::equal) steps_[s].equals.push_back(rival);
      }
    }
    return any;
  }

  // What may take an effect's place. Beside the newest one nothing has changed since it was chosen:
  // only what predicted clearly better then.
  std::vector<std::size_t> rivals_of(std::size_t s) const {
    const std::vector<Trial>& tried = steps_[s].tried;
    const auto own = std::ranges::find(tried, steps_[s].effect, &Trial::effect);
    const bool is_newest = s + 1 == steps_.size() && own != tried.end();
    std::vector<std::size_t> rivals;
    for (std::size_t i = 0; i < std::min(tried.size(), most_rivals); ++i) {
      const Trial& rival = tried[i];
      if (rival.effect() == steps_[s].effect || !rival.fit.not_certified.empty()) continue;
      const bool could_be = rival.refused.empty() && rival.held_out.log_density.size() > 0;
      if (is_newest && !(could_be && margin(rival.held_out, own->held_out).is_clear())) continue;
      rivals.push_back(rival.effect());
    }
    return rivals;
  }

  // What a rival is in an effect's place, beside the other effects.
  enum class Beside { worse, equal, better };

  // Takes it where it is better.
  // @param rest  the present model without the effect of step s
  Beside try_exchange(std::size_t s, const Standing& rest, std::size_t effect) {
    const double now = now_.fit.cost, without = rest.fit.cost;
    const MustBeat now_stands{without * std::pow(now / without, most_of_the_way), now};
    Trial trial = try_effect(on_, foreseen(rest), effect, now_stands);
    if (!trial.refused.empty()) return Beside::worse;
    if (const Margin apart = margin(trial.held_out, foreseen_.held_out); !apart.is_clear()) {
      return apart.delta >= -2 * apart.se ? Beside::equal : Beside::worse;
    }
    const Trial tried = trial;
    auto standing = confirm(on_, rest, trial);
    if (!trial.refused.empty()) return Beside::worse;
    if (!margin(trial.held_out, now_.held_out).is_clear()) return Beside::equal;
    steps_[s] = step_of(trial, tried, {tried}, rest.fit.cost);
    go_on_from(std::move(*standing));
    return Beside::better;
  }

  // The present model without one of its effects, fitted anew.
  std::optional<Standing> refit_without(std::size_t effect) const {
    std::vector<std::size_t> effects = now_.fit.effects;
    const auto place = std::ranges::find(effects, effect);
    const std::size_t at = first_value_of(on_.model, effects, std::size_t(place - effects.begin()));
    effects.erase(place);
    std::vector<double> start = now_.fit.values;
    const auto first = start.begin() + std::ptrdiff_t(at);
    start.erase(first, first + std::ptrdiff_t(on_.model.library()[effect].parameters.size()));
    const Fit fit = fit_from(on_.model, effects, {start}, on_.everything, now_.fit.scatter);
    if (fit.residuals.size() == 0) return std::nullopt;
    return stand(on_, polish(on_.model, fit, on_.everything), LeftOut::refitted);
  }

  void drop_needless() {
    if (steps_.size() < 2) return;
    for (std::size_t s = 0; s < steps_.size();) {
      const auto without = refit_without(steps_[s].effect);
      if (without && !foretells_more(on_, now_, *without)) {
        go_on_from(*without);
        steps_.erase(steps_.begin() + std::ptrdiff_t(s));
      } else {
        ++s;
      }
    }
  }

  // As exactly as differences allow, which is no use while effects are still missing.
  void finish() {
    const Fit exact = polish(on_.model, now_.fit, on_.everything);
    if (!exact.not_certified.empty()) return;
    if (auto standing = stand(on_, exact, LeftOut::refitted)) now_ = std::move(*standing);
  }

  Tryout on_;
  const SelectionOptions& options_;
  Standing now_;       // left-out conditions by refits
  Standing foreseen_;  // the same, forecast
  std::vector<Step> steps_;
  Marks marks_;                     // of the base
  std::vector<Screened> screened_;  // at the present step
  std::vector<Trial> last_tried_;
};

}  // namespace

Selection select_effects(const ForwardModel& model, const SelectionOptions& options) {
  return Selector(model, options).run();
}

}  // namespace rvbench::analysis
