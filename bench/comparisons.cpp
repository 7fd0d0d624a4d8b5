#include "bench/comparisons.hpp"

#include <algorithm>
#include <map>

#include "analysis/explain/predictive_error.hpp"

namespace rvbench::bench {
namespace {

constexpr double nine_in_ten = 1.645;  // standard deviations of a normal distribution
constexpr std::size_t most_shown = 3;

// d mean / d value of each comparison, over its channel's spread; one column for each value.
Eigen::MatrixXd slopes_of_means(const Twin& twin, const analysis::Fit& fit,
                                const std::vector<Twin::Comparison>& here) {
  constexpr double step_of_scale = 1e-3;
  const auto parameters = analysis::parameters_of(twin, fit.effects);
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(Eigen::Index(here.size()),
                                                 static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    std::vector<double> moved = fit.values;
    double step = step_of_scale * parameters[p].scale;
    if (moved[p] + step > parameters[p].high) step = -step;
    moved[p] += step;
    const auto there = twin.compare(fit.effects, moved);
    for (std::size_t i = 0; i < there.size(); ++i) {
      slopes(Eigen::Index(i), static_cast<Eigen::Index>(p)) =
          (there[i].simulated.mean() - here[i].simulated.mean()) / step / here[i].spread;
    }
  }
  return slopes;
}

// Whose label each record carries.
std::map<std::string, const analysis::ObservedUnit*> labels_of(const Twin& twin) {
  std::map<std::string, const analysis::ObservedUnit*> labels;
  for (const analysis::ObservedUnit& unit : twin.units()) labels.try_emplace(unit.record, &unit);
  return labels;
}

// What repeats of a record's programme scatter by around what is simulated, as half-widths; empty
// if none repeats it. Programmes never repeat to the sample, so signals are not compared
// themselves.
Eigen::VectorXd scatter_of(const Twin& twin, const std::vector<Twin::Comparison>& all,
                           const Twin::Comparison& own) {
  const auto labels = labels_of(twin);
  const auto label = labels.find(own.record);
  if (label == labels.end() || label->second->programme.empty()) return {};
  std::vector<Eigen::VectorXd> repeats;
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(own.measured.size());
  for (const Twin::Comparison& other : all) {
    const auto of = labels.find(other.record);
    const bool repeats_it = of != labels.end() && other.channel == own.channel &&
                            of->second->programme == label->second->programme &&
                            other.measured.size() == mean.size();
    if (!repeats_it) continue;
    repeats.emplace_back(other.measured - other.simulated);
    mean += repeats.back();
  }
  if (repeats.size() < 2) return {};
  const auto count = static_cast<double>(repeats.size());
  mean /= count;
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(mean.size());
  for (const Eigen::VectorXd& repeat : repeats) squares += (repeat - mean).cwiseAbs2();
  return nine_in_ten * (squares / (count - 1)).cwiseSqrt();
}

// Where a fit would have come to rest without what is measured under one condition.
std::vector<double> without(const Twin& twin, const analysis::Fit& fit,
                            const std::string& condition) {
  std::vector<bool> trained;
  for (const analysis::ObservedUnit& unit : twin.units()) {
    trained.push_back(unit.condition != condition);
  }
  return analysis::foresee(twin, fit, trained).values;
}

// Of what was only to be predicted the first few; else the first record of the first, the middle
// and the last condition.
std::vector<std::string> shown_records(const Twin& twin, const Comparisons& all) {
  std::vector<std::string> shown;
  for (const Twin::Comparison& one : all.before) {
    const bool is_new = std::ranges::find(shown, one.record) == shown.end();
    if (!one.learned_from && is_new && shown.size() < most_shown) shown.push_back(one.record);
  }
  if (!shown.empty()) return shown;
  std::vector<const analysis::ObservedUnit*> first;
  for (const analysis::ObservedUnit& unit : twin.units()) {
    const bool is_new = std::ranges::none_of(
        first, [&](const auto* other) { return other->condition == unit.condition; });
    if (is_new) first.push_back(&unit);
  }
  if (first.size() < 2) return {};
  for (std::size_t i = 0; i < most_shown; ++i) {
    const std::string& record = first[i * (first.size() - 1) / (most_shown - 1)]->record;
    if (std::ranges::find(shown, record) == shown.end()) shown.push_back(record);
  }
  return shown;
}

void add_unseen(const Twin& twin, const analysis::Selection& found, Comparisons& all) {
  const auto labels = labels_of(twin);
  for (const std::string& record : shown_records(twin, all)) {
    const auto label = labels.find(record);
    std::vector<Twin::Comparison> before = all.before, after = all.after;
    if (label != labels.end()) {
      const std::string& condition = label->second->condition;
      before = twin.compare(found.base.effects, without(twin, found.base, condition));
      after = twin.compare(found.fit.effects, without(twin, found.fit, condition));
    }
    if (before.size() != all.before.size() || after.size() != all.after.size()) continue;
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (before[i].record != record) continue;
      all.unseen.push_back({before[i], after[i], scatter_of(twin, all.after, all.after[i])});
    }
  }
}

}  // namespace

Comparisons compare(const Twin& twin, const analysis::Selection& found) {
  if (found.base.residuals.size() == 0) return {};  // nothing was fitted
  Comparisons both{twin.compare(found.base.effects, found.base.values),
                   twin.compare(found.fit.effects, found.fit.values),
                   {}};
  if (both.before.size() != both.after.size()) return {};
  add_unseen(twin, found, both);
  return both;
}

std::vector<RecordError> record_errors(const Twin& twin, const analysis::Selection& found,
                                       const Comparisons& comparisons) {
  const auto& [before, after, unseen] = comparisons;
  std::vector<RecordError> errors;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Twin::Comparison& b = before[i];
    errors.push_back({b.record, b.channel, b.unit, b.learned_from, b.error(), after[i].error(),
                      b.relative_error(), after[i].relative_error()});
  }
  if (twin.counts_standard_errors() || std::ranges::all_of(errors, &RecordError::learned_from)) {
    return errors;
  }
  const analysis::PredictiveError error(twin, found.fit);
  const Eigen::MatrixXd slopes = slopes_of_means(twin, found.fit, after);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (errors[i].learned_from) continue;
    const Twin::Comparison& a = after[i];
    errors[i].mean = {a.measured.mean(), a.simulated.mean(),
                      a.spread * error.half_width_90(slopes.row(Eigen::Index(i)))};
  }
  return errors;
}

}  // namespace rvbench::bench
