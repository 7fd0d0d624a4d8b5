#include "bench/qualification/golden_evidence.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <variant>

#include "analysis/station/golden_check.hpp"
#include "bench/ledger.hpp"
#include "bench/qualification/ages.hpp"
#include "bench/qualification/golden_runs.hpp"
#include "bench/results/run_filter.hpp"
#include "bench/run_folder.hpp"
#include "bench/run_start.hpp"
#include "hal/types/measure.hpp"

namespace rvbench::bench {
namespace {

bool was_judged(const RunRow& run) {
  return run.verdict == to_string(Outcome::pass) || run.verdict == to_string(Outcome::fail) ||
         run.verdict == to_string(Outcome::invalid);
}

std::string name_of(const ChartedIndicator& indicator, const SetPoint& point) {
  std::string name = indicator.measure;
  if (!indicator.of.empty()) name += " of " + indicator.of;
  if (!point.is_any())
    name += fmt::format(" at {:g} rpm, {:g} %", *point.speed_rpm, *point.load_pct);
  return name;
}

Result<GoldenChart> chart_in(const ResultDatabase& database, const GoldenUnitDemand& demand,
                             const ChartedIndicator& indicator, const SetPoint& point,
                             const std::vector<RunRow>& runs) {
  SeriesOf asked{
      .measure = indicator.measure, .of = indicator.of, .at = point, .serial = demand.serial};
  const Measure* measure = find_measure(indicator.measure);
  asked.least = measure != nullptr && measure->worst_is_least;
  const auto series = database.series(asked);
  if (!series) return series.error();
  std::map<std::string, double> value_by_folder;
  for (const RunValue& value : series.value()) value_by_folder[value.folder] = value.value;
  GoldenChart chart{name_of(indicator, point), {}, false};
  for (const RunRow& run : runs) {
    const auto value = value_by_folder.find(run.folder);
    chart.has_newest = value != value_by_folder.end();
    // What did not pass is no measure of others, and what measured badly tells nothing.
    const bool is_in_baseline = static_cast<int>(chart.values.size()) < demand.baseline_runs;
    const bool counts = run.verdict == to_string(Outcome::pass) ||
                        (run.verdict == to_string(Outcome::fail) && !is_in_baseline);
    if (chart.has_newest && counts) chart.values.push_back(value->second);
  }
  return chart;
}

// Of one chart; nothing if it is in control.
std::optional<std::string> chart_fault(const GoldenChart& chart, int baseline_runs) {
  if (!chart.has_newest) return "its newest run has no " + chart.name;
  const Eigen::VectorXd values =
      Eigen::VectorXd::Map(chart.values.data(), static_cast<Eigen::Index>(chart.values.size()));
  const auto checked = analysis::check_golden(values, baseline_runs);
  if (checked.index() == 1) return chart.name + ": " + std::get<1>(checked);
  const analysis::GoldenCheck& check = std::get<0>(checked);
  if (check.is_in_control()) return std::nullopt;
  return fmt::format("{} is {:.4g}, {} (centre {:.4g}, 3 sigma {:.3g})", chart.name, check.value,
                     check.text(), check.baseline.centre, 3 * check.baseline.sigma);
}

// What is wrong with a run that has ended; "" if the results are of what the ledger has.
std::string doubt_of(const std::filesystem::path& root, const LedgerLine& ended,
                     const RunRow* row) {
  if (row != nullptr && row->sha256 == ended.sha256) return "";
  const std::string fault = fault_of(root, ended);
  const std::string run = (root / ended.file).parent_path().string();
  return fault.empty() ? run + " was changed: rvbench check tells what" : fault;
}

// Whether a folder says that its run was none of this golden unit's. One that lacks a file says
// nothing.
bool is_of_another(const QualificationSection& section, const std::filesystem::path& run) {
  const GoldenUnitDemand& demand = *section.golden_unit;
  std::error_code unknown;
  if (std::filesystem::exists(run / "rig.json", unknown)) {
    const RigOfRun rig = rig_of(run);
    const bool is_of_this = rig.station == section.station && rig.kind == section.rig_kind &&
                            rig.golden_serial == demand.serial && rig.golden_plan == demand.plan;
    if (!is_of_this) return true;
  }
  return std::filesystem::exists(run / "plan.json", unknown) && plan_name_in(run) != demand.plan;
}

// Runs that measured something and that the ledger does not know, by their folders and by the
// results: it may have lost its newest lines. Nobody asks for those from before the first that
// counts.
std::vector<std::string> unknown_runs(const std::filesystem::path& root,
                                      const QualificationSection& section, const Ledger& ledger,
                                      const std::vector<GoldenLines>& lines,
                                      const std::vector<RunRow>& rows) {
  const GoldenUnitDemand& demand = *section.golden_unit;
  const int first = demand.since_utc.empty() || lines.empty()
                        ? 0
                        : read_run_begin(root / lines.front().folder).number;
  const auto known = last_lines(ledger);
  const auto is_known = [&](const std::string& folder) {
    return known.contains((std::filesystem::path(folder) / "start.json").string());
  };
  std::set<std::string> unknown;
  const auto note = [&](const std::string& folder, const std::string& utc, int number) {
    if (utc < demand.since_utc || number < first) return;
    if (!is_of_another(section, root / folder)) unknown.insert((root / folder).string());
  };
  for (const std::filesystem::path& run : folders_in(root / folder_name_of(demand.serial))) {
    std::error_code error;
    const std::string folder = run.lexically_relative(root).string();
    if (is_known(folder) || !std::filesystem::exists(run / "recording.h5", error)) continue;
    const RunBegin begin = read_run_begin(run);
    note(folder, begin.started_utc, begin.number);
  }
  for (const RunRow& row : rows) {
    const bool is_here = row.station == section.station && row.rig_kind == section.rig_kind;
    if (!is_here || row.plan != demand.plan || !was_judged(row) || is_known(row.folder)) continue;
    note(row.folder, row.started_utc, row.number);
  }
  return {unknown.begin(), unknown.end()};
}

// What the ledger's runs came to, in their order.
void take_runs(GoldenEvidence& evidence, const std::filesystem::path& root,
               const std::vector<GoldenLines>& lines, const std::vector<RunRow>& rows) {
  std::map<std::string, const RunRow*> row_by_folder;
  for (const RunRow& row : rows) row_by_folder[row.folder] = &row;
  for (const GoldenLines& run : lines) {
    const RunRow* row = row_by_folder[run.folder];
    const std::string doubt = run.ended != nullptr ? doubt_of(root, *run.ended, row) : "";
    evidence.newest_without_verdict.clear();
    if (run.ended == nullptr) {
      evidence.newest_without_verdict =
          fmt::format("({}) {}", readable_utc(run.begun->utc),
                      is_at_work(root / run.folder) ? "is still at work: wait for its end"
                                                    : "did not come to its end: repeat it");
    } else if (!doubt.empty()) {
      evidence.doubts.push_back(doubt);
    } else if (was_judged(*row)) {
      evidence.runs.push_back(*row);
    } else {
      evidence.newest_without_verdict =
          fmt::format("({}) ended {}: {}: repeat it", readable_utc(row->started_utc), row->verdict,
                      row->reason);
    }
  }
}

// Without those of another plan.
std::vector<std::string> reasons_of(const GoldenEvidence& evidence, const GoldenUnitDemand& demand,
                                    const std::string& now_utc) {
  const std::string unit = "golden unit " + demand.serial + ": ";
  if (!evidence.unreadable.empty())
    return {unit + "its runs cannot be read: " + evidence.unreadable};
  std::vector<std::string> reasons;
  if (const std::size_t doubts = evidence.doubts.size(); doubts > 0) {
    const std::string more = doubts > 1 ? fmt::format(", as {} more of its runs", doubts - 1) : "";
    reasons.push_back(unit + evidence.doubts[0] + more +
                      ": put back a copy, or begin its chart anew, by \"since\" in the rig file");
  }
  if (!evidence.newest_without_verdict.empty()) {
    reasons.push_back(unit + "its newest run " + evidence.newest_without_verdict);
  }
  if (evidence.runs.empty()) {
    const std::string since =
        demand.since_utc.empty() ? "" : " since " + readable_utc(demand.since_utc);
    reasons.push_back(unit + "it has no run of plan " + demand.plan + " on this station" + since);
    return reasons;
  }
  const RunRow& newest = evidence.runs.back();
  const std::string age = age_fault(newest.started_utc, demand.max_age_h, now_utc);
  if (!age.empty()) reasons.push_back(unit + "its newest run " + age);
  if (newest.verdict != to_string(Outcome::pass)) {
    reasons.push_back(fmt::format("{}its newest run ({}) ended {}: {}", unit,
                                  readable_utc(newest.started_utc), newest.verdict, newest.reason));
    return reasons;  // whatever its charts say
  }
  for (const GoldenChart& chart : evidence.charts) {
    if (const auto reason = chart_fault(chart, demand.baseline_runs)) {
      reasons.push_back(unit + *reason);
    }
  }
  return reasons;
}

}  // namespace

GoldenEvidence golden_evidence(const Result<ResultDatabase>& database, const Ledger& ledger,
                               const QualificationSection& section) {
  const GoldenUnitDemand& demand = *section.golden_unit;
  GoldenEvidence evidence;
  const auto unreadable = [](const IoError& why) {
    GoldenEvidence none;
    none.unreadable = describe(why);
    return none;
  };
  if (!database) return unreadable(database.error());
  const std::filesystem::path& root = database.value().root();
  const auto rows = database.value().runs(demand.serial);
  if (!rows) return unreadable(rows.error());
  std::vector<GoldenLines> lines = golden_lines(ledger, section);
  for (const std::string& run : unknown_runs(root, section, ledger, lines, rows.value())) {
    evidence.doubts.push_back(run + " is in no line of ledger.jsonl, which may have lost some");
  }
  const std::string plan = lines.empty() ? "" : lines.front().plan_sha256;
  evidence.of_another_plan = static_cast<int>(
      std::erase_if(lines, [&](const GoldenLines& run) { return run.plan_sha256 != plan; }));
  take_runs(evidence, root, lines, rows.value());
  if (evidence.runs.empty()) return evidence;
  std::vector<SetPoint> points = demand.points;
  if (points.empty()) points.emplace_back();  // any: the worst of all
  for (const ChartedIndicator& indicator : demand.indicators) {
    for (const SetPoint& point : points) {
      auto chart = chart_in(database.value(), demand, indicator, point, evidence.runs);
      if (!chart) return unreadable(chart.error());
      evidence.charts.push_back(std::move(chart).value());
    }
  }
  return evidence;
}

std::vector<std::string> golden_reasons(const GoldenEvidence& evidence,
                                        const GoldenUnitDemand& demand,
                                        const std::string& now_utc) {
  std::vector<std::string> reasons = reasons_of(evidence, demand, now_utc);
  if (!reasons.empty() && evidence.of_another_plan > 0) {
    reasons.push_back(
        fmt::format("golden unit {}: {} of its runs are of a plan that is called {}, too, but is "
                    "not the one of its first: they do not count",
                    demand.serial, evidence.of_another_plan, demand.plan));
  }
  return reasons;
}

}  // namespace rvbench::bench
