#include "bench/qualification/golden_evidence.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>
#include <variant>

#include "analysis/station/golden_check.hpp"
#include "bench/qualification/ages.hpp"
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
    if (chart.has_newest) chart.values.push_back(value->second);
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

}  // namespace

GoldenEvidence golden_evidence(const Result<ResultDatabase>& database,
                               const std::filesystem::path& root,
                               const QualificationSection& section) {
  const GoldenUnitDemand& demand = *section.golden_unit;
  GoldenEvidence evidence;
  const auto unreadable = [](const IoError& error) {
    GoldenEvidence none;
    none.unreadable = describe(error);
    return none;
  };
  if (!database) return unreadable(database.error());
  const auto runs = database.value().runs(demand.serial);
  if (!runs) return unreadable(runs.error());
  for (const RunRow& run : runs.value()) {
    const bool is_here = run.station == section.station && run.rig_kind == section.rig_kind;
    if (!is_here || run.plan != demand.plan || !was_judged(run)) continue;
    if (is_as_entered(root, run)) {
      evidence.runs.push_back(run);
    } else {
      evidence.changed.push_back(run.folder);
    }
  }
  for (const RunRow& run : damaged_runs(root, runs.value())) {
    const RigOfRun rig = rig_of(root / run.folder);
    const bool is_here = rig.station == section.station && rig.kind == section.rig_kind;
    if (is_here && run.serial == demand.serial && run.plan == demand.plan) {
      evidence.changed.push_back(run.folder);
    }
  }
  std::ranges::stable_sort(evidence.runs, {}, &RunRow::number);  // clocks may have been set
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
  const std::string unit = "golden unit " + demand.serial + ": ";
  if (!evidence.unreadable.empty())
    return {unit + "its runs cannot be read: " + evidence.unreadable};
  std::vector<std::string> reasons;
  for (const std::string& folder : evidence.changed) {
    reasons.push_back(unit + folder + " is gone, or its verdict.json was changed: put back a copy");
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
  }
  for (const GoldenChart& chart : evidence.charts) {
    if (const auto reason = reason_of(chart, demand.baseline_runs)) {
      reasons.push_back(unit + *reason);
    }
  }
  return reasons;
}

}  // namespace rvbench::bench
