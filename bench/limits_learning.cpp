#include "bench/limits_learning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/limit_checks.hpp"
#include "bench/results/run_filter.hpp"
#include "hal/types/measure.hpp"

namespace rvbench::bench {
namespace {

using analysis::LimitSide;
using sequences::Limit;

bool is_learnable(const Limit& limit) { return limit.measure != measure_names::modulation_depth; }

LimitSide side_of(const Limit& limit) {
  return std::isfinite(limit.min) ? LimitSide::min : LimitSide::max;
}

double bound_of(const Limit& limit) { return std::isfinite(limit.min) ? limit.min : limit.max; }

// Those in force, and one for each measure that is asked for and has none.
std::vector<Limit> asked_limits(const LearningTask& task) {
  std::vector<Limit> asked;
  for (const Limit& limit : task.in_force) {
    const bool wanted = task.measures.empty() ||
                        std::ranges::find(task.measures, limit.measure) != task.measures.end();
    if (wanted && is_learnable(limit)) asked.push_back(limit);
  }
  for (const std::string& name : task.measures) {
    const Measure* measure = find_measure(name);
    if (measure == nullptr || std::ranges::find(asked, name, &Limit::measure) != asked.end()) {
      continue;
    }
    const Limit limit{name, "", std::string(measure->units.front()), not_known, "", "", not_known};
    if (is_learnable(limit)) asked.push_back(limit);
  }
  return asked;
}

bool is_from_below(const Limit& limit) {
  const Measure* measure = find_measure(limit.measure);
  const bool has_none = std::isnan(limit.min) && std::isnan(limit.max);
  return has_none ? measure->worst_is_least : side_of(limit) == LimitSide::min;
}

// Runs by folder: their serials.
struct Runs {
  std::map<std::string, std::string> good;    // the newest PASS of each good unit
  std::map<std::string, std::string> judged;  // every PASS and FAIL of the plan
};

Runs runs_of(const std::vector<RunRow>& rows, const LearningTask& task) {
  std::map<std::string, std::string> newest;  // folder by serial; rows are oldest first
  Runs runs;
  for (const RunRow& row : rows) {
    if (row.plan != task.plan) continue;
    if (row.verdict == "PASS" || row.verdict == "FAIL") runs.judged[row.folder] = row.serial;
    const bool is_good = task.serials.empty() || task.serials.contains(row.serial);
    if (row.verdict == "PASS" && is_good) newest[row.serial] = row.folder;
  }
  for (const auto& [serial, folder] : newest) runs.good[folder] = serial;
  return runs;
}

std::string why_of(const LearntLimit& learnt, const analysis::Coverage& coverage,
                   const std::string& utc) {
  const analysis::RobustLimit& robust = learnt.proposal.learnt;
  return fmt::format(
      "median {} {} {:.2f} robust sigma of {} good units ({:g} % of all with {:g} % "
      "confidence), {}",
      with_unit(robust.median, learnt.limit.unit),
      learnt.proposal.side == LimitSide::max ? "+" : "-", robust.factor, robust.units,
      100 * coverage.content, 100 * coverage.confidence, readable_utc(utc).substr(0, 10));
}

Result<LearntLimit> learn(const ResultDatabase& database, const LearningTask& task,
                          const Runs& runs, const Limit& limit) {
  const bool least = is_from_below(limit);
  const auto values = database.series({.measure = limit.measure, .of = limit.of, .least = least});
  if (!values) return values.error();
  analysis::IndicatorHistory history{
      limit.measure, "", least ? LimitSide::min : LimitSide::max, {}, {}};
  history.limit = bound_of(limit);
  history.has_limit = std::isfinite(history.limit);
  std::vector<std::string> serials;
  for (const RunValue& run : values.value()) {
    const double value = in_unit(run.value, run.unit, limit.unit);
    if (!std::isfinite(value)) continue;
    if (runs.judged.contains(run.folder)) history.history.push_back(value);
    if (!runs.good.contains(run.folder)) continue;
    history.good.push_back(value);
    serials.push_back(run.serial);
  }
  LearntLimit learnt{
      limit, history.limit, analysis::propose_limits({history}, task.coverage).at(0), {}};
  for (const std::size_t i : learnt.proposal.learnt.set_aside) {
    learnt.set_aside.push_back(serials[i]);
  }
  return learnt;
}

}  // namespace

Result<LearntLimits> learn_limits(const ResultDatabase& database, const LearningTask& task,
                                  const std::string& utc) {
  const auto rows = database.runs();
  if (!rows) return rows.error();
  const Runs runs = runs_of(rows.value(), task);
  LearntLimits all;
  all.file = {task.version, task.plan, {}, task.in_force};
  for (const Limit& limit : asked_limits(task)) {
    auto learnt = learn(database, task, runs, limit);
    if (!learnt) return learnt.error();
    LearntLimit one = std::move(learnt).value();
    if (one.proposal.refusal.empty()) {
      const bool is_min = one.proposal.side == LimitSide::min;
      one.limit.min = is_min ? one.proposal.learnt.limit : not_known;
      one.limit.max = is_min ? not_known : one.proposal.learnt.limit;
      one.limit.why = why_of(one, task.coverage, utc);
      const auto old = std::ranges::find_if(all.file.limits, [&](const Limit& l) {
        return l.measure == limit.measure && l.of == limit.of &&
               std::isfinite(l.min) == std::isfinite(limit.min);
      });
      if (old != all.file.limits.end()) {
        *old = one.limit;
      } else {
        all.file.limits.push_back(one.limit);
      }
    }
    all.learnt.push_back(std::move(one));
  }
  return all;
}

std::string learnt_text(const LearntLimits& learnt) {
  std::string text;
  for (const LearntLimit& one : learnt.learnt) {
    const analysis::LimitProposal& proposal = one.proposal;
    const std::string name =
        one.limit.measure + (one.limit.of.empty() ? "" : " of " + one.limit.of);
    const std::string old =
        std::isfinite(one.in_force) ? with_unit(one.in_force, one.limit.unit) : "none";
    if (!proposal.refusal.empty()) {
      text += fmt::format("{}: not learnt: {}; in force: {}\n", name, proposal.refusal, old);
      continue;
    }
    const analysis::RobustLimit& robust = proposal.learnt;
    text += fmt::format(
        "{}: {} {}, in force {}\n  of {} units: median {}, MAD {}, factor {:.2f}; {:.1f} % of {} "
        "judged runs would change\n",
        name, proposal.side == LimitSide::min ? "min" : "max",
        with_unit(robust.limit, one.limit.unit), old, robust.units,
        with_unit(robust.median, one.limit.unit), with_unit(robust.mad, one.limit.unit),
        robust.factor, 100 * proposal.share_that_changes(), proposal.judged);
    for (const std::string& serial : one.set_aside) {
      text += "  set aside, unlike the others: " + serial + "\n";
    }
  }
  return text;
}

}  // namespace rvbench::bench
