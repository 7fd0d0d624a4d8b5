#include "bench/serve/station_state.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "bench/json_text.hpp"
#include "bench/serve/station.hpp"

namespace rvbench::bench {
namespace {

const char* word_of(char state) {
  switch (state) {
    case 'm': return "measuring";
    case 'd': return "done";
    case 'f': return "failed";
    default: return "open";
  }
}

}  // namespace

std::string verdict_of_answer(const nlohmann::json& answer, const std::string& run,
                              const std::filesystem::path& runs) {
  auto findings = nlohmann::json::array();
  if (answer.contains("findings") && answer["findings"].is_array()) {
    for (const auto& finding : answer["findings"]) {
      findings.push_back({{"component", finding.value("component", "unknown")},
                          {"mechanism", finding.value("mechanism", "unknown")},
                          {"advice", finding.value("advice", "")}});
    }
  }
  const bool has_word = answer.contains("verdict") && answer["verdict"].is_string();
  std::error_code unknown;
  const bool has_report =
      !run.empty() && std::filesystem::exists(runs / run / "report.html", unknown);
  return json_line(
      nlohmann::json({{"word", has_word ? answer["verdict"] : nlohmann::json("ERROR")},
                      {"exit_code", answer.value("exit_code", -1)},
                      {"code", answer.value("code", answer.value("error_kind", "none"))},
                      {"reason", answer.value("reason", "")},
                      {"findings", findings},
                      {"run", run},
                      {"report", has_report ? "/api/runs/" + run + "/report" : ""}}));
}

nlohmann::json matrix_of(const std::vector<hal::PlannedPoint>& points, const std::string& states) {
  std::set<double> speeds_rpm, loads_pct;
  int repeats = 0;
  auto cells = nlohmann::json::array();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const hal::PlannedPoint& point = points[i];
    if (std::isfinite(point.speed_rpm)) speeds_rpm.insert(point.speed_rpm);
    if (std::isfinite(point.load_pct)) loads_pct.insert(point.load_pct);
    repeats = std::max(repeats, point.repeat);
    cells.push_back({{"speed_rpm", point.speed_rpm},
                     {"load_pct", point.load_pct},
                     {"repeat", point.repeat},
                     {"status", word_of(i < states.size() ? states[i] : 'o')}});
  }
  return {{"speeds_rpm", speeds_rpm},
          {"loads_pct", loads_pct},
          {"repeats", repeats},
          {"cells", std::move(cells)}};
}

const char* Station::to_string(Phase phase) {
  switch (phase) {
    case Phase::idle: return "idle";
    case Phase::ready: return "ready";
    case Phase::duplicate: return "duplicate";
    case Phase::running: return "running";
    case Phase::ended: return "ended";
  }
  return "?";
}

std::string Station::next_action(const StationViewer& viewer) const {
  if (phase_ == Phase::running) return "wait";
  if (phase_ == Phase::ended) return "read_verdict";
  if (!reasons_.empty()) return "station_not_qualified";
  if (phase_ == Phase::idle) return viewer.role < Role::operating ? "not_allowed" : "scan";
  if (viewer.role < Role::operating || (viewer.is_remote && !file_.remote_start)) {
    return "not_allowed";
  }
  return phase_ == Phase::duplicate ? "decide_retest" : "start";
}

std::string Station::state(const StationViewer& viewer) const {
  const std::lock_guard lock(mutex_);
  auto known = nlohmann::json::array();
  for (const KnownRun& run : known_) {
    known.push_back(
        {{"run", run.run},
         {"started_utc", run.started_utc},
         {"verdict", run.verdict.empty() ? nlohmann::json() : nlohmann::json(run.verdict)}});
  }
  return json_line(nlohmann::json(
      {{"station", {{"name", file_.name}, {"qualified", reasons_.empty()}, {"reasons", reasons_}}},
       {"phase", to_string(phase_)},
       {"serial", serial_},
       {"known_runs", std::move(known)},
       {"plan", file_.plan},
       {"rig", file_.rig},
       {"progress",
        {{"phase", progress_.stage},
         {"text", progress_.text},
         {"done", progress_.done},
         {"left_s", progress_.left_s}}},
       {"matrix", matrix_of(points_, point_states_)},
       {"verdict", parse_json(verdict_)},
       {"next_action", next_action(viewer)}}));
}

// Each listener is told in its own words: what it may do next differs.
void Station::tell_change() {
  std::string now = state({Role::engineer, false});
  {
    const std::lock_guard lock(mutex_);
    if (now == told_) return;
    told_ = std::move(now);
  }
  hub_.publish("state", "");
}

}  // namespace rvbench::bench
