#include "bench/qualification/station_records.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "bench/examination_json.hpp"
#include "bench/json_text.hpp"
#include "bench/ledger.hpp"
#include "bench/qualification/self_test_json.hpp"
#include "bench/results/run_filter.hpp"
#include "bench/run_folder.hpp"
#include "bench/text_file.hpp"

namespace rvbench::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* calibration = "calibration";
constexpr const char* self_test = "self_test";
constexpr const char* suffix = ".json";

Json to_json(const CalibrationRecord& record) {
  return {{"record", calibration},
          {"station", record.station},
          {"channel", record.channel},
          {"sensitivity", record.sensitivity},
          {"certificate", record.certificate},
          {"by", record.by},
          {"calibrated_utc", record.calibrated_utc},
          {"valid_until_utc", record.valid_until_utc},
          {"entered_utc", record.entered_utc},
          {"software", record.software}};
}

Json to_json(const SelfTestRecord& record) {
  return {{"record", self_test},     {"station", record.station},     {"rig", record.rig_kind},
          {"utc", record.utc},       {"software", record.software},   {"passed", record.passed},
          {"reason", record.reason}, {"steps", json_of(record.steps)}};
}

std::string calibration_kind(const CalibrationRecord& record) {
  return "calibration of " + record.channel + " by " + record.certificate;
}

CalibrationRecord calibration_from(const Json& json) {
  CalibrationRecord record;
  json.at("station").get_to(record.station);
  json.at("channel").get_to(record.channel);
  record.sensitivity = number_or_nan(json.at("sensitivity"));
  json.at("certificate").get_to(record.certificate);
  json.at("by").get_to(record.by);
  json.at("calibrated_utc").get_to(record.calibrated_utc);
  json.at("valid_until_utc").get_to(record.valid_until_utc);
  json.at("entered_utc").get_to(record.entered_utc);
  json.at("software").get_to(record.software);
  return record;
}

SelfTestRecord self_test_from(const Json& json) {
  SelfTestRecord record;
  json.at("station").get_to(record.station);
  json.at("rig").get_to(record.rig_kind);
  json.at("utc").get_to(record.utc);
  json.at("software").get_to(record.software);
  json.at("passed").get_to(record.passed);
  json.at("reason").get_to(record.reason);
  record.steps = self_test_from_json(json.at("steps"));
  return record;
}

// What is no time would never be too old.
bool are_times(const std::vector<std::string>& texts) {
  return std::ranges::all_of(texts, [](const auto& utc) { return days_of_utc(utc).has_value(); });
}

// "[json.exception.parse_error.101] parse error at line 1, ...": without what is in brackets.
std::string without_name(const std::string& what) {
  const auto end = what.find("] ");
  return end == std::string::npos ? what : what.substr(end + 2);
}

// @return why it cannot be used; "" if it can
std::string why_not_taken(StationRecords& records, const std::filesystem::path& file) {
  try {
    const Json json = Json::parse(read_file(file).value_or(""));
    const std::string kind = json.at("record").get<std::string>();
    const std::string name = file.filename().string();
    if (kind == calibration) {
      CalibrationRecord record = calibration_from(json);
      if (!are_times({record.calibrated_utc, record.valid_until_utc, record.entered_utc})) {
        return "a time in it is none";
      }
      record.file = name;
      records.calibrations.push_back(std::move(record));
      return "";
    }
    if (kind != self_test) return "it is no record of a station";
    SelfTestRecord record = self_test_from(json);
    if (!are_times({record.utc})) return "its time is none";
    record.file = name;
    records.self_tests.push_back(std::move(record));
    return "";
  } catch (const nlohmann::json::exception& error) {
    return without_name(error.what());
  }
}

std::string take(StationRecords& records, const std::filesystem::path& file) {
  const std::string why = why_not_taken(records, file);
  return why.empty() ? "" : file.string() + " is damaged: " + why;
}

bool tells_the_same(const SelfTestRecord& a, const SelfTestRecord& b) {
  return a.station == b.station && a.rig_kind == b.rig_kind;
}

bool tells_the_same(const CalibrationRecord& a, const CalibrationRecord& b) {
  return a.station == b.station && a.channel == b.channel && a.certificate == b.certificate;
}

// Of a file that is in no line. The ledger may have lost its newest lines: without it an older
// record would count again, until the same is told anew. @return nothing if it was
std::optional<DamagedRecord> unknown_record(const StationRecords& records,
                                            const std::filesystem::path& file) {
  const std::string sentence = file.string() + in_no_line;
  StationRecords one;
  if (!take(one, file).empty()) return DamagedRecord{"", "", sentence + ": take it away"};
  const auto is_told_anew = [](const auto& record, const auto& kept, auto time) {
    return std::ranges::any_of(kept, [&](const auto& other) {
      return tells_the_same(record, other) && other.*time > record.*time;
    });
  };
  if (!one.self_tests.empty()) {
    const SelfTestRecord& record = one.self_tests[0];
    if (is_told_anew(record, records.self_tests, &SelfTestRecord::utc)) return std::nullopt;
    return DamagedRecord{record.station, self_test_kind(record.rig_kind), sentence + ": test anew"};
  }
  const CalibrationRecord& record = one.calibrations[0];
  if (is_told_anew(record, records.calibrations, &CalibrationRecord::entered_utc)) {
    return std::nullopt;
  }
  return DamagedRecord{record.station, calibration_kind(record),
                       sentence + ": enter that certificate again"};
}

// A file of the folder, as the ledger and the records name it.
std::string below_root(const std::string& name) {
  return std::string(qualification_folder_name) + "/" + name;
}

std::string keep(const std::filesystem::path& root, const char* prefix, const std::string& kind,
                 const std::string& station, const std::string& utc, const Json& json) {
  LedgerPen pen(root);
  const std::filesystem::path folder = qualification_folder(root);
  std::string name = std::string(prefix) + "-" + utc + suffix;
  for (int copy = 2; std::filesystem::exists(folder / name); ++copy) {
    name = std::string(prefix) + "-" + utc + "-" + std::to_string(copy) + suffix;
  }
  pen.keep(kind, station, below_root(name), json_text(json));
  return name;
}

}  // namespace

std::filesystem::path qualification_folder(const std::filesystem::path& root) {
  return root / qualification_folder_name;
}

StationRecords read_station_records(const std::filesystem::path& root) {
  const LedgerReading reading(root);
  StationRecords records;
  const Ledger ledger = read_ledger(root);
  if (!ledger.fault.empty()) {
    records.damaged.push_back({"", "", ledger.fault + ": put back a copy"});
    return records;
  }
  // By kind and station: only what tells the same takes the place of what is damaged.
  std::map<std::pair<std::string, std::string>, DamagedRecord> damaged;
  for (const LedgerLine& line : ledger.lines) {
    if (!line.file.starts_with(below_root(""))) continue;
    std::string why = fault_of(root, line);
    if (why.empty()) why = take(records, root / line.file);
    damaged.erase({line.kind, line.of});
    if (why.empty()) continue;
    why += line.kind.starts_with(self_test) ? ": put back a copy, or test anew"
                                            : ": put back a copy, or enter that certificate again";
    damaged[{line.kind, line.of}] = {line.of, line.kind, why};
  }
  for (auto& [kind, record] : damaged) records.damaged.push_back(std::move(record));
  for (const std::filesystem::path& file : json_files_in(qualification_folder(root))) {
    if (ledger.last_of(below_root(file.filename().string())) != nullptr) continue;
    const auto unknown = unknown_record(records, file);
    if (unknown) records.damaged.push_back(*unknown);
  }
  return records;
}

std::string self_test_kind(const std::string& rig_kind) {
  return std::string(self_test) + " of a rig of kind " + rig_kind;
}

std::string keep_record(const std::filesystem::path& root, const CalibrationRecord& record) {
  return keep(root, calibration, calibration_kind(record), record.station, record.entered_utc,
              to_json(record));
}

std::string keep_record(const std::filesystem::path& root, const SelfTestRecord& record) {
  return keep(root, self_test, self_test_kind(record.rig_kind), record.station, record.utc,
              to_json(record));
}

}  // namespace rvbench::bench
