#include "bench/limits_learning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "bench/limit_checks.hpp"
#include "bench/results/run_filter.hpp"
#include "hal/types/measure.hpp"
#include "sequences/limits_on_plan.hpp"

namespace rvbench::bench {
namespace {

using analysis::LimitSide;
using sequences::Limit;

bool is_of_depth(const Limit& limit) { return limit.measure == measure_names::modulation_depth; }

LimitSide side_of(const Limit& limit) {
  return std::isfinite(limit.min) ? LimitSide::min : LimitSide::max;
}

double bound_of(const Limit& limit) { return std::isfinite(limit.min) ? limit.min : limit.max; }

// Those in force, and one for each measure that is asked for and has none.
std::vector<Limit> limits_to_learn(const LearningTask& task) {
  std::vector<Limit> asked;
  for (const Limit& limit : task.plan.limits) {
    const bool wanted = task.measures.empty() ||
                        std::ranges::find(task.measures, limit.measure) != task.measures.end();
    if (wanted && !is_of_depth(limit)) asked.push_back(limit);
  }
  for (const std::string& name : task.measures) {
    const Measure* measure = find_measure(name);
    if (measure == nullptr || std::ranges::find(asked, name, &Limit::measure) != asked.end()) {
      continue;
    }
    const Limit limit{name, "", std::string(measure->units.front()), not_known, "", "", not_known};
    if (!is_of_depth(limit)) asked.push_back(limit);
  }
  const std::string depth(measure_names::modulation_depth);
  if (!task.measures.empty() && std::ranges::find(task.measures, depth) == task.measures.end()) {
    return asked;
  }
  for (const std::string& part : task.parts) {
    asked.push_back({depth, part, "1", not_known, "", "", not_known});
  }
  return asked;
}

bool is_from_below(const Limit& limit) {
  const Measure* measure = find_measure(limit.measure);
  const bool has_none = std::isnan(limit.min) && std::isnan(limit.max);
  return has_none ? measure->worst_is_least : side_of(limit) == LimitSide::min;
}

bool is_same_but_for_points(const Limit& a, const Limit& b) {
  return a.measure == b.measure && a.of == b.of && a.component == b.component &&
         is_from_below(a) == is_from_below(b);
}

// Of each limit one for each point that it holds at and that shows it, and no two alike.
std::vector<Limit> at_each_point(const std::vector<Limit>& limits,
                                 const sequences::TestPlan& plan) {
  std::vector<Limit> split;
  for (const Limit& limit : limits) {
    if (is_of_depth(limit)) {
      split.push_back(limit);  // concluded from all points together
      continue;
    }
    for (const SetPoint& point : sequences::set_points_of(*find_measure(limit.measure), plan)) {
      if (!overlap(limit.at, point)) continue;
      Limit one = limit;
      one.at = point;
      const bool is_there = std::ranges::any_of(split, [&](const Limit& other) {
        return other.at == point && is_same_but_for_points(other, one);
      });
      if (!is_there) split.push_back(std::move(one));
    }
  }
  return split;
}

// The strictest of those that hold at all points of this one, in its unit; NaN if there is none.
double bound_in_force(const Limit& limit, const std::vector<Limit>& in_force) {
  double strictest = not_known;
  for (const Limit& other : in_force) {
    const bool is_of_all = is_of_depth(limit) && is_of_depth(other) && other.component.empty();
    if (!is_of_all && !is_same_but_for_points(limit, other)) continue;
    if (!covers(other.at, limit.at)) continue;
    const double bound = in_unit(bound_of(other), other.unit, limit.unit);
    strictest = is_from_below(limit) ? std::fmax(strictest, bound) : std::fmin(strictest, bound);
  }
  return strictest;
}

// Runs by folder: their serials.
struct Runs {
  std::map<std::string, std::string> good;    // the newest run of each good unit that passed it
  std::map<std::string, std::string> judged;  // every PASS and FAIL of the plan
  std::vector<std::string> changed;
};

Runs runs_of(std::vector<RunRow> rows, const std::filesystem::path& root,
             const LearningTask& task) {
  std::ranges::stable_sort(rows, {}, &RunRow::number);  // of a serial: clocks may have been set
  std::map<std::string, std::string> newest;            // folder by serial
  Runs runs;
  for (const RunRow& row : rows) {
    if (row.plan != task.plan.name || row.rig_kind != task.rig_kind) continue;
    if (row.verdict != "PASS" && row.verdict != "FAIL") continue;
    if (!is_as_entered(root, row)) {
      runs.changed.push_back(row.folder);
      newest.erase(row.serial);  // it may have been a FAIL
      continue;
    }
    runs.judged[row.folder] = row.serial;
    const bool is_good = task.serials.empty() || task.serials.contains(row.serial);
    if (!is_good) continue;
    // A unit that failed since is no good one, whatever it was before.
    if (row.verdict == "FAIL") newest.erase(row.serial);
    if (row.verdict == "PASS") newest[row.serial] = row.folder;
  }
  for (const auto& [serial, folder] : newest) runs.good[folder] = serial;
  return runs;
}

std::string why_of(const LearntLimit& learnt, const LearningTask& task, const std::string& utc) {
  const analysis::Coverage& coverage = task.coverage;
  const analysis::RobustLimit& robust = learnt.proposal.learnt;
  const std::string claim =
      learnt.is_doubtful()
          ? fmt::format("{} of them set aside: how many of all are within is not known",
                        learnt.set_aside.size())
          : fmt::format("{:g} % of all with {:g} % confidence if they scatter normally",
                        100 * coverage.content, 100 * coverage.confidence);
  return fmt::format("median {} {} {:.2f} robust sigma of {} good units ({}), rig {}, {}",
                     with_unit(robust.median, learnt.limit.unit),
                     learnt.proposal.side == LimitSide::max ? "+" : "-", robust.factor,
                     robust.units, claim, task.rig_kind, readable_utc(utc).substr(0, 10));
}

// What judged runs and good units show of one limit.
struct Taught {
  analysis::IndicatorHistory history;
  std::vector<std::string> serials;  // of the good values, in their order
};

Result<Taught> taught(const ResultDatabase& database, const LearningTask& task, const Runs& runs,
                      const Limit& limit) {
  const bool least = is_from_below(limit);
  const auto values = database.series({.measure = limit.measure,
                                       .of = is_of_depth(limit) ? limit.component : limit.of,
                                       .at = limit.at,
                                       .least = least,
                                       .may_be_hid = true});
  if (!values) return values.error();
  Taught all;
  analysis::IndicatorHistory& history = all.history;
  history.indicator = limit.measure;
  history.point = text_of(limit.at);
  history.side = least ? LimitSide::min : LimitSide::max;
  history.limit = bound_in_force(limit, task.plan.limits);
  history.has_limit = std::isfinite(history.limit);
  for (const RunValue& run : values.value()) {
    const double value = in_unit(run.value, run.unit, limit.unit);
    if (!std::isfinite(value)) continue;
    if (runs.judged.contains(run.folder)) history.history.push_back(value);
    if (!runs.good.contains(run.folder)) continue;
    history.good.push_back(value);
    all.serials.push_back(run.serial);
  }
  return all;
}

LearntLimit learnt_of(const Limit& limit, const Taught& taught, analysis::LimitProposal proposal,
                      const LearningTask& task, const std::string& utc) {
  LearntLimit learnt{limit, taught.history.limit, std::move(proposal), {}};
  for (const std::size_t i : learnt.proposal.learnt.set_aside) {
    learnt.set_aside.push_back(taught.serials[i]);
  }
  if (!learnt.proposal.refusal.empty()) return learnt;
  const bool is_min = learnt.proposal.side == LimitSide::min;
  learnt.limit.min = is_min ? learnt.proposal.learnt.limit : not_known;
  learnt.limit.max = is_min ? not_known : learnt.proposal.learnt.limit;
  learnt.limit.why = why_of(learnt, task, utc);
  return learnt;
}

// In place of the one that bounds the same, or as a further one.
void put(std::vector<Limit>& limits, const Limit& limit) {
  const auto old = std::ranges::find_if(limits, [&](const Limit& other) {
    return other.at == limit.at && is_same_but_for_points(other, limit);
  });
  if (old != limits.end()) {
    *old = limit;
  } else {
    limits.push_back(limit);
  }
}

}  // namespace

Result<LearntLimits> learn_limits(const ResultDatabase& database, const LearningTask& task,
                                  const std::string& utc) {
  const auto rows = database.runs();
  if (!rows) return rows.error();
  const Runs runs = runs_of(rows.value(), database.root(), task);
  std::vector<Limit> limits = limits_to_learn(task);
  if (task.per_point) limits = at_each_point(limits, task.plan);
  std::vector<Taught> all_taught;
  std::vector<analysis::IndicatorHistory> histories;
  for (const Limit& limit : limits) {
    auto one = taught(database, task, runs, limit);
    if (!one) return one.error();
    all_taught.push_back(std::move(one).value());
    histories.push_back(all_taught.back().history);
  }
  const auto proposals = analysis::propose_limits(histories, task.coverage);
  LearntLimits all;
  all.file = {task.version, task.plan.name, {}, task.plan.limits};
  all.changed = runs.changed;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    all.learnt.push_back(learnt_of(limits[i], all_taught[i], proposals[i], task, utc));
    if (proposals[i].refusal.empty()) put(all.file.limits, all.learnt.back().limit);
  }
  return all;
}

Result<std::set<std::string>> rig_kinds_of(const ResultDatabase& database,
                                           const std::string& plan) {
  const auto rows = database.runs();
  if (!rows) return rows.error();
  std::set<std::string> kinds;
  for (const RunRow& row : rows.value()) {
    const bool tells_more = !row.rig_kind.empty() && !kinds.contains(row.rig_kind);
    const bool teaches = tells_more && row.plan == plan && row.verdict == "PASS";
    if (teaches && is_as_entered(database.root(), row)) kinds.insert(row.rig_kind);
  }
  return kinds;
}

std::set<std::string> serials_in(const std::string& text) {
  std::set<std::string> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with('\r')) line.pop_back();
    if (!line.empty()) found.insert(line);
  }
  return found;
}

std::string kind_to_learn_from(const std::set<std::string>& kinds) {
  for (const char* kind : {"bench", "replay", "sim"}) {
    if (kinds.contains(kind)) return kind;
  }
  return "";
}

std::string learnt_text(const LearntLimits& learnt) {
  std::string text;
  for (const std::string& folder : learnt.changed) {
    text += folder + ": teaches nothing: it is gone, or its verdict.json was changed\n";
  }
  for (const LearntLimit& one : learnt.learnt) {
    const analysis::LimitProposal& proposal = one.proposal;
    const std::string& of = one.limit.of.empty() ? one.limit.component : one.limit.of;
    const std::string name =
        one.limit.measure + (of.empty() ? "" : " of " + of) + at_text(one.limit.at);
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
    if (one.is_doubtful()) {
      text += fmt::format(
          "  {} of {} good units are unlike the others: these values are skewed, or not all units "
          "are good; how many of all the limit leaves within is not known\n",
          one.set_aside.size(), robust.units);
    }
    for (const std::string& serial : one.set_aside) {
      text += "  set aside, unlike the others: " + serial + "\n";
    }
  }
  return text;
}

}  // namespace rvbench::bench
