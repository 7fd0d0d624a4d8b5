#include "bench/results/entry.hpp"

#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "bench/limits_versions.hpp"

namespace rvbench::bench {
namespace {

// The run keeps its number: other tables go by it.
constexpr const char* put_run =
    "INSERT INTO runs (folder, serial, started_utc, plan, verdict, error_kind, reason, software, "
    "number, rig_kind, station, verdict_sha256, is_whole) "
    "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, 1) "
    "ON CONFLICT (folder) DO UPDATE SET serial = ?2, started_utc = ?3, plan = ?4, verdict = ?5, "
    "error_kind = ?6, reason = ?7, software = ?8, number = ?9, rig_kind = ?10, station = ?11, "
    "verdict_sha256 = ?12, is_whole = 1";
constexpr const char* put_unit =
    "INSERT INTO units VALUES (?1, ?2) ON CONFLICT (serial) DO UPDATE SET machine = ?2";
constexpr const char* put_judgement =
    "INSERT OR REPLACE INTO judgements SELECT id, ?2, ?3, ?4, ?5, ?6, ?7, ?8 FROM runs "
    "WHERE folder = ?1";
// The values of all quantities: by the quantity their key begins.
constexpr const char* remove_values =
    "DELETE FROM indicators WHERE run = ?1 AND quantity IN (SELECT id FROM quantities)";
constexpr const char* remove_extremes =
    "DELETE FROM extremes WHERE run = ?1 AND quantity IN (SELECT id FROM quantities)";

constexpr const char* get_limits =
    "SELECT 1 FROM limits_versions WHERE version = ?1 AND plan = ?2 AND status = ?3 "
    "AND approved_by = ?4 AND approved_utc = ?5 AND activated_by = ?6 AND activated_utc = ?7";
constexpr const char* put_limits =
    "INSERT OR REPLACE INTO limits_versions VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)";

constexpr const char* put_calibration =
    "INSERT OR IGNORE INTO calibrations VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10)";
constexpr const char* put_self_test =
    "INSERT OR IGNORE INTO self_tests VALUES (?1, ?2, ?3, ?4, ?5, ?6)";
constexpr const char* put_reading =
    "INSERT OR IGNORE INTO self_test_readings VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)";

class RunEntry {
 public:
  RunEntry(SqliteFile& file, std::int64_t run) : file_(file), run_(run) {}

  bool clear() {
    for (const char* sql :
         {"DELETE FROM points WHERE run = ?1", "DELETE FROM findings WHERE run = ?1", remove_values,
          remove_extremes}) {
      SqlStatement removal(file_, sql);
      removal.bind(run_);
      if (!removal.run()) return false;
    }
    return true;
  }

  bool put_point(int number, const JudgedPoint& point) {
    const analysis::Examination& seen = point.examination;
    point_.bind(run_, number, point.status, point.planned_speed_rpm, seen.load_pct, seen.repeat,
                point.torque_Nm);
    if (!point_.run() || !put_values(number, "", seen.indicators)) return false;
    for (const analysis::ChannelExamination& channel : seen.channels) {
      if (!put_values(number, channel.name, channel.indicators)) return false;
    }
    return true;
  }

  // Of all values that were put.
  bool put_extremes() {
    SqlStatement extremes(file_, "INSERT INTO extremes VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)");
    for (const auto& [of, values] : extremes_) {
      const auto& [quantity, channel] = of;
      const auto& [least, greatest] = values;
      extremes.bind(quantity, run_, channel, greatest.value, greatest.point, least.value,
                    least.point);
      if (!extremes.run()) return false;
    }
    return true;
  }

  bool put_findings(const std::vector<analysis::Finding>& findings, const std::string& standing) {
    for (const analysis::Finding& f : findings) {
      finding_.bind(run_, rank_++, standing, f.component, f.mechanism, f.table4_item, f.order,
                    f.severity, f.severity_low, f.severity_high, f.limit, f.p_value, f.confidence);
      if (!finding_.run()) return false;
    }
    return true;
  }

 private:
  struct Value {
    double value;
    int point;
  };
  struct Extremes {
    Value least, greatest;
  };

  // Of equal ones the first.
  void note(std::int64_t quantity, const std::string& channel, const Value& at) {
    Extremes& of = extremes_.try_emplace({quantity, channel}, Extremes{at, at}).first->second;
    if (at.value < of.least.value) of.least = at;
    if (at.value > of.greatest.value) of.greatest = at;
  }

  bool put_values(int point, const std::string& channel,
                  const std::vector<analysis::Indicator>& indicators) {
    for (const analysis::Indicator& indicator : indicators) {
      const std::int64_t quantity = number_of(indicator);
      if (quantity == 0) return false;
      value_.bind(quantity, run_, point, channel, indicator.value);
      if (!value_.run()) return false;
      note(quantity, channel, {indicator.value, point});
    }
    return true;
  }

  // @return 0 if it cannot be had
  std::int64_t number_of(const analysis::Indicator& indicator) {
    const auto key = std::tuple(indicator.measure, indicator.of, indicator.unit);
    std::int64_t& number = quantities_[key];
    if (number != 0) return number;
    new_quantity_.bind(indicator.measure, indicator.of, indicator.unit);
    if (!new_quantity_.run()) return 0;
    quantity_.bind(indicator.measure, indicator.of, indicator.unit);
    if (quantity_.next()) number = quantity_.integer(0);
    return number;
  }

  SqliteFile& file_;
  const std::int64_t run_;
  int rank_ = 0;
  std::map<std::tuple<std::string, std::string, std::string>, std::int64_t> quantities_;
  std::map<std::pair<std::int64_t, std::string>, Extremes> extremes_;  // of quantity and channel
  SqlStatement point_{file_, "INSERT INTO points VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)"};
  SqlStatement finding_{file_,
                        "INSERT INTO findings VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, "
                        "?11, ?12, ?13)"};
  SqlStatement value_{file_, "INSERT OR REPLACE INTO indicators VALUES (?1, ?2, ?3, ?4, ?5)"};
  SqlStatement new_quantity_{
      file_, "INSERT OR IGNORE INTO quantities (measure, of_what, unit) VALUES (?1, ?2, ?3)"};
  SqlStatement quantity_{
      file_, "SELECT id FROM quantities WHERE measure = ?1 AND of_what = ?2 AND unit = ?3"};
};

bool put_all(RunEntry& entry, const Judgement& judgement) {
  if (!entry.clear()) return false;
  int number = 0;
  for (const JudgedPoint& point : judgement.points) {
    if (!entry.put_point(number++, point)) return false;
  }
  if (!entry.put_extremes()) return false;
  const analysis::Diagnosis& diagnosis = judgement.diagnosis;
  return entry.put_findings(diagnosis.findings, "above_limit") &&
         entry.put_findings(diagnosis.below_limit, "below_limit") &&
         entry.put_findings(diagnosis.not_shown, "not_shown");
}

}  // namespace

Status enter_run(SqliteFile& file, const RunRow& row, const Judgement& judgement) {
  SqlStatement run(file, put_run);
  run.bind(row.folder, row.serial, row.started_utc, row.plan, row.verdict, row.error_kind,
           row.reason, row.software, row.number, row.rig_kind, row.station, row.sha256);
  if (!run.run()) return file.failure("cannot be written");
  SqlStatement unit(file, put_unit);
  unit.bind(row.serial, judgement.machine);
  SqlStatement number(file, "SELECT id FROM runs WHERE folder = ?1");
  number.bind(row.folder);
  if (!unit.run() || !number.next()) return file.failure("cannot be written");
  RunEntry entry(file, number.integer(0));
  if (!put_all(entry, judgement)) return file.failure("cannot be written");
  return enter_judgement_row(file, {.folder = row.folder,
                                    .file = "verdict.json",
                                    .judged_utc = row.started_utc,
                                    .software = row.software,
                                    .limits_version = judgement.facts.limits_version,
                                    .verdict = row.verdict,
                                    .error_kind = row.error_kind,
                                    .reason = row.reason});
}

Status enter_judgement_row(SqliteFile& file, const JudgementRow& row) {
  SqlStatement judgement(file, put_judgement);
  judgement.bind(row.folder, row.file, row.judged_utc, row.software, row.limits_version,
                 row.verdict, row.error_kind, row.reason);
  if (!judgement.run()) return file.failure("cannot be written");
  return Done{};
}

Status enter_limits_version(SqliteFile& file, const LimitsVersion& limits) {
  const auto step = [&](const char* name) {
    const LimitsStep* found = last_step(limits.file, name);
    return found == nullptr ? LimitsStep{} : *found;
  };
  const LimitsStep approved = step("approved"), activated = step("activated");
  for (const char* sql : {get_limits, put_limits}) {
    SqlStatement statement(file, sql);
    statement.bind(limits.version, limits.file.plan, limits.status, approved.by, approved.utc,
                   activated.by, activated.utc);
    if (statement.next()) return Done{};
    if (!statement.is_done()) return file.failure("cannot be written");
  }
  return Done{};
}

Status enter_station_records(SqliteFile& file, const StationRecords& records) {
  for (const CalibrationRecord& record : records.calibrations) {
    SqlStatement row(file, put_calibration);
    row.bind(record.file, record.station, record.channel, record.sensitivity, record.certificate,
             record.by, record.calibrated_utc, record.valid_until_utc, record.entered_utc,
             record.software);
    if (!row.run()) return file.failure("cannot be written");
  }
  for (const SelfTestRecord& record : records.self_tests) {
    SqlStatement row(file, put_self_test);
    row.bind(record.file, record.station, record.utc, record.software, int{record.passed},
             record.reason);
    if (!row.run()) return file.failure("cannot be written");
    for (const SelfTestResult& step : record.steps) {
      for (const SelfTestReading& reading : step.readings) {
        SqlStatement value(file, put_reading);
        value.bind(record.file, step.step, reading.of, reading.value, reading.limit, reading.unit,
                   std::string(to_string(reading.word)));
        if (!value.run()) return file.failure("cannot be written");
      }
    }
  }
  return Done{};
}

}  // namespace rvbench::bench
