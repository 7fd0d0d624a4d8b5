#include "bench/qualification/golden_evidence.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
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
    // What did not pass is no measure of others.
    const bool is_in_baseline = static_cast<int>(chart.values.size()) < demand.baseline_runs;
    const bool counts = !is_in_baseline || run.verdict == to_string(Outcome::pass);
    if (chart.has_newest && counts) chart.values.push_back(value->second);
  }
  return chart;
}

// Of one chart; nothing if it is in control.
std::optional<std::string> reason_of(const GoldenChart& chart, int baseline_runs) {
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

// What is wrong with a run that the ledger has; "" if it is as it was kept.
std::string doubt_of(const std::filesystem::path& root, const GoldenLines& run,
                     const std::map<std::string, RunRow>& row_by_folder) {
  std::string fault = fault_of(root, *run.begun);
  if (fault.empty() && run.ended != nullptr) fault = fault_of(root, *run.ended);
  if (!fault.empty() || run.ended == nullptr) return fault;
  const auto row = row_by_folder.find(run.folder);
  const bool is_told = row != row_by_folder.end() && row->second.sha256 == run.ended->sha256;
  return is_told ? "" : (root / run.folder).string() + " was changed: rvbench check tells what";
}

// Runs on this station that measured something, and that the ledger does not know: it may have lost
// its newest lines.
std::vector<std::string> unknown_runs(const std::filesystem::path& root,
                                      const QualificationSection& section, const Ledger& ledger) {
  const GoldenUnitDemand& demand = *section.golden_unit;
  std::vector<std::string> unknown;
  for (const std::filesystem::path& run : folders_in(root / folder_name_of(demand.serial))) {
    std::error_code error;
    if (!std::filesystem::exists(run / "recording.h5", error)) continue;
    const RigOfRun rig = rig_of(run);
    const bool is_here = rig.station == section.station && rig.kind == section.rig_kind;
    if (!is_here || rig.golden_serial != demand.serial || plan_name_in(run) != demand.plan)
      continue;
    const std::string start = (run.lexically_relative(root) / "start.json").string();
    const bool is_of_now = read_run_begin(run).started_utc >= demand.since_utc;
    if (is_of_now && ledger.last_of(start) == nullptr) unknown.push_back(run.string());
  }
  std::ranges::sort(unknown);
  return unknown;
}

// What the ledger's runs came to, in their order.
void take_runs(GoldenEvidence& evidence, const std::filesystem::path& root,
               const std::vector<GoldenLines>& lines, const std::vector<RunRow>& rows) {
  std::map<std::string, RunRow> row_by_folder;
  for (const RunRow& row : rows) row_by_folder[row.folder] = row;
  for (const GoldenLines& run : lines) {
    const std::string doubt = doubt_of(root, run, row_by_folder);
    evidence.newest_without_verdict.clear();
    if (!doubt.empty()) {
      evidence.doubts.push_back(doubt);
    } else if (run.ended == nullptr) {
      evidence.newest_without_verdict =
          fmt::format("({}) came to no verdict", readable_utc(run.begun->utc));
    } else if (const RunRow& row = row_by_folder.at(run.folder); was_judged(row)) {
      evidence.runs.push_back(row);
    } else {
      evidence.newest_without_verdict =
          fmt::format("({}) ended {}: {}", readable_utc(row.started_utc), row.verdict, row.reason);
    }
  }
}

}  // namespace

GoldenEvidence golden_evidence(const Result<ResultDatabase>& database,
                               const QualificationSection& section) {
  const GoldenUnitDemand& demand = *section.golden_unit;
  GoldenEvidence evidence;
  const auto unreadable = [](const std::string& why) {
    GoldenEvidence none;
    none.unreadable = why;
    return none;
  };
  if (!database) return unreadable(describe(database.error()));
  const std::filesystem::path& root = database.value().root();
  const auto rows = database.value().runs(demand.serial);
  if (!rows) return unreadable(describe(rows.error()));
  const Ledger ledger = read_ledger(root);
  if (!ledger.fault.empty()) return unreadable(ledger.fault);
  take_runs(evidence, root, golden_lines(ledger, section), rows.value());
  for (const std::string& run : unknown_runs(root, section, ledger)) {
    evidence.doubts.push_back(run + " is in no line of ledger.jsonl, which may have lost some");
  }
  if (evidence.runs.empty()) return evidence;
  std::vector<SetPoint> points = demand.points;
  if (points.empty()) points.emplace_back();  // any: the worst of all
  for (const ChartedIndicator& indicator : demand.indicators) {
    for (const SetPoint& point : points) {
      auto chart = chart_in(database.value(), demand, indicator, point, evidence.runs);
      if (!chart) return unreadable(describe(chart.error()));
      evidence.charts.push_back(std::move(chart).value());
    }
  }
  return evidence;
}

std::vector<std::string> golden_reasons(const GoldenEvidence& evidence,
                                        const GoldenUnitDemand& demand,
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
    reasons.push_back(unit + "its newest run " + evidence.newest_without_verdict + ": repeat it");
  }
  if (evidence.runs.empty()) {
    reasons.push_back(unit + "it has no run of plan " + demand.plan + " on this station");
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
    if (const auto reason = reason_of(chart, demand.baseline_runs)) {
      reasons.push_back(unit + *reason);
    }
  }
  return reasons;
}

}  // namespace rvbench::bench
