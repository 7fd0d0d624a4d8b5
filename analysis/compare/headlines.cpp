#include "analysis/compare/headlines.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr double strong_dB = 10;  // ten times the power: more does not say whose line it is

struct Gathered {
  Headline headline;
  std::vector<double> changes_dB;
  std::set<std::size_t> points;
};

void gather(const Comparison& comparison, std::size_t index, Gathered& into) {
  const Change& change = comparison.changes[index];
  if (!change.seen) return;
  ++into.headline.compared;
  if (change.word != ChangeWord::changed) return;
  const bool first = into.changes_dB.empty();
  const double strongest_dB = comparison.changes[into.headline.strongest].change_dB;
  if (first || std::abs(change.change_dB) > std::abs(strongest_dB)) {
    into.headline.strongest = index;
  }
  into.changes_dB.push_back(change.change_dB);
  into.points.insert(change.point);
}

Headline completed(Gathered gathered) {
  Headline headline = gathered.headline;
  headline.changed = gathered.changes_dB.size();
  headline.points = gathered.points.size();
  const auto [least, most] = std::ranges::minmax_element(gathered.changes_dB);
  headline.least_dB = *least;
  headline.most_dB = *most;
  headline.median_dB = median(std::move(gathered.changes_dB));
  return headline;
}

std::vector<std::size_t> unparted_from(std::size_t family, const Comparison& comparison) {
  std::vector<std::size_t> others;
  for (const auto& [one, other] : comparison.unparted) {
    if (one == family) others.push_back(other);
    if (other == family) others.push_back(one);
  }
  return others;
}

double weight(const Headline& h) { return static_cast<double>(h.changed) * std::abs(h.median_dB); }

// Two lines of two say less than eleven of twelve.
double weight(const FamilyHeadline& f) {
  const double share = static_cast<double>(f.changed + 1) / static_cast<double>(f.cells + 2);
  return share * std::min(std::abs(f.median_dB), strong_dB);
}

// Without those that an earlier one is named with.
std::vector<FamilyHeadline> each_named_once(std::vector<FamilyHeadline> sorted) {
  std::set<std::size_t> named;
  std::erase_if(sorted, [&](const FamilyHeadline& f) {
    const bool is_known = !named.insert(f.family).second;
    if (!is_known) named.insert(f.or_of.begin(), f.or_of.end());
    return is_known;
  });
  return sorted;
}

}  // namespace

std::vector<Headline> headlines(const Comparison& comparison) {
  std::vector<Gathered> all(comparison.quantities.size());
  for (std::size_t i = 0; i < comparison.changes.size(); ++i) {
    const std::size_t quantity = comparison.changes[i].quantity;
    all[quantity].headline.quantity = quantity;
    gather(comparison, i, all[quantity]);
  }
  std::vector<Headline> told;
  for (Gathered& one : all) {
    if (!one.changes_dB.empty()) told.push_back(completed(std::move(one)));
  }
  std::ranges::stable_sort(told, std::greater<>(), [](const Headline& h) { return weight(h); });
  return told;
}

std::vector<FamilyHeadline> family_headlines(const Comparison& comparison) {
  std::map<std::size_t, FamilyHeadline> families;
  std::map<std::size_t, std::vector<double>> changes_dB;
  for (const Change& change : comparison.changes) {
    for (const std::size_t family : comparison.quantities[change.quantity].families) {
      FamilyHeadline& headline = families[family];
      headline.family = family;
      ++headline.cells;
      if (!change.seen || change.word != ChangeWord::changed) continue;
      ++headline.changed;
      changes_dB[family].push_back(change.change_dB);
    }
  }
  std::vector<FamilyHeadline> told;
  for (auto& [family, changes] : changes_dB) {
    told.push_back(families[family]);
    const auto [least, most] = std::ranges::minmax_element(changes);
    told.back().least_dB = *least;
    told.back().most_dB = *most;
    told.back().median_dB = median(std::move(changes));
    told.back().or_of = unparted_from(family, comparison);
  }
  std::ranges::stable_sort(told, std::greater<>(),
                           [](const FamilyHeadline& f) { return weight(f); });
  return each_named_once(std::move(told));
}

ChangeCounts counts_of(const Comparison& comparison) {
  ChangeCounts counts;
  std::vector<double> detectable_dB;
  for (const Change& change : comparison.changes) {
    const bool changed = change.word == ChangeWord::changed;
    if (!change.seen) {
      counts.noise_changed += changed ? 1 : 0;
    } else if (changed) {
      ++counts.changed;
    } else if (change.word == ChangeWord::not_changed) {
      ++counts.not_changed;
      detectable_dB.push_back(change.detectable_dB);
    } else {
      ++counts.cannot_tell;
    }
  }
  if (!detectable_dB.empty()) counts.median_detectable_dB = median(std::move(detectable_dB));
  return counts;
}

ChangeWord word_of(const ChangeCounts& counts) {
  if (counts.changed > 0) return ChangeWord::changed;
  return counts.not_changed > 0 && counts.not_changed >= counts.cannot_tell
             ? ChangeWord::not_changed
             : ChangeWord::cannot_tell;
}

}  // namespace rvbench::analysis
