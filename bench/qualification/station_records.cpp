#include "bench/qualification/station_records.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "bench/examination_json.hpp"
#include "bench/json_text.hpp"
#include "bench/ledger.hpp"
#include "bench/qualification/self_test_json.hpp"
#include "bench/results/run_filter.hpp"
#include "bench/run_folder.hpp"
#include "bench/text_file.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* calibration = "calibration";
constexpr const char* self_test = "self_test";
constexpr const char* clock = "clock";
constexpr const char* set_aside_kind = "set aside";
constexpr const char* suffix = ".json";

Json to_json(const CalibrationRecord& record) {
  return hal::json_object({{"record", calibration},
                           {"station", record.station},
                           {"channel", record.channel},
                           {"sensitivity", record.sensitivity},
                           {"certificate", record.certificate},
                           {"by", record.by},
                           {"calibrated_utc", record.calibrated_utc},
                           {"valid_until_utc", record.valid_until_utc},
                           {"entered_utc", record.entered_utc},
                           {"software", record.software}});
}

Json to_json(const SelfTestRecord& record) {
  return {{"record", self_test},           {"station", record.station},
          {"rig", record.rig_kind},        {"utc", record.utc},
          {"software", record.software},   {"passed", record.passed},
          {"reason", record.reason},       {"judged_by", parse_ordered_json(record.judged_by)},
          {"steps", json_of(record.steps)}};
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
  record.judged_by = json_line(json.at("judged_by"));
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
    const Json json = parse_ordered_json(read_file(file).value_or(""));
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
    if (kind == clock) return "";
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

// What takes the place of a record of that kind.
std::string remedy_of(const std::string& kind) {
  if (kind.starts_with(self_test)) return "test anew";
  return kind == clock_kind ? "say it again: rvbench qualify clock"
                            : "enter that certificate again";
}

// Of a file that is in no line: the ledger may have lost its newest ones, and an older record would
// count again.
DamagedRecord unknown_record(const std::filesystem::path& file) {
  const std::string sentence = file.string() + in_no_line + ": ";
  StationRecords one;
  if (!take(one, file).empty()) return {"", "", sentence + "take it away"};
  std::string station, kind = clock_kind;
  for (const SelfTestRecord& record : one.self_tests) {
    station = record.station;
    kind = self_test_kind(record.rig_kind);
  }
  for (const CalibrationRecord& record : one.calibrations) {
    station = record.station;
    kind = calibration_kind(record.channel, record.certificate);
  }
  return {station, kind, sentence + remedy_of(kind)};
}

// A file of the folder, as the ledger and the records name it.
std::string below_root(const std::string& name) {
  return std::string(qualification_folder_name) + "/" + name;
}

std::vector<std::filesystem::path> files_in_no_line(const Ledger& ledger,
                                                    const std::filesystem::path& root) {
  const auto known = last_lines(ledger);
  std::vector<std::filesystem::path> files = json_files_in(qualification_folder(root));
  std::erase_if(files, [&](const std::filesystem::path& file) {
    return known.contains(below_root(file.filename().string()));
  });
  return files;
}

// Files in no line that told the same as what has just been told anew: from here on they are known,
// and nobody goes by them.
void set_aside(LedgerPen& pen, const std::filesystem::path& root, const std::string& kind,
               const std::string& station) {
  for (const std::filesystem::path& file : files_in_no_line(read_ledger(root), root)) {
    const DamagedRecord unknown = unknown_record(file);
    if (unknown.kind != kind || unknown.station != station) continue;
    pen.enter(set_aside_kind, station, below_root(file.filename().string()));
  }
}

// That no file has yet.
std::string new_name(const std::filesystem::path& root, const char* prefix,
                     const std::string& utc) {
  const std::filesystem::path folder = qualification_folder(root);
  std::string name = std::string(prefix) + "-" + utc + suffix;
  for (int copy = 2; std::filesystem::exists(folder / name); ++copy) {
    name = std::string(prefix) + "-" + utc + "-" + std::to_string(copy) + suffix;
  }
  return name;
}

std::string keep(const std::filesystem::path& root, const char* prefix, const std::string& kind,
                 const std::string& station, const std::string& utc, const Json& json) {
  LedgerPen pen(root);
  const std::string name = new_name(root, prefix, utc);
  pen.keep(kind, station, below_root(name), json_text(json));
  set_aside(pen, root, kind, station);
  return name;
}

// In their order, without what was set aside; of one file the last, which tells what came of it.
std::vector<const LedgerLine*> lines_of_records(const Ledger& ledger) {
  const auto last_by_file = last_lines(ledger);
  std::vector<const LedgerLine*> lines;
  for (const LedgerLine& line : ledger.lines) {
    const bool is_record = line.file.starts_with(below_root("")) && line.kind != set_aside_kind;
    if (is_record && last_by_file.at(line.file) == &line) lines.push_back(&line);
  }
  return lines;
}

StationRecords records_of(const std::filesystem::path& root, const Ledger& ledger,
                          const std::vector<const LedgerLine*>& lines) {
  StationRecords records;
  records.clock_fault = clock_fault(ledger, utc_now());
  if (!ledger.fault.empty()) {
    records.damaged.push_back({"", "", ledger.fault + ": put back a copy"});
    return records;
  }
  // By kind and station: only what tells the same takes the place of what is damaged.
  std::map<std::pair<std::string, std::string>, DamagedRecord> damaged;
  for (const LedgerLine* line : lines) {
    std::string why = fault_of(root, *line);
    if (why.empty()) why = take(records, root / line->file);
    damaged.erase({line->kind, line->of});
    if (why.empty()) continue;
    why += ": put back a copy, or " + remedy_of(line->kind);
    damaged[{line->kind, line->of}] = {line->of, line->kind, why};
  }
  for (auto& [kind, record] : damaged) records.damaged.push_back(std::move(record));
  for (const std::filesystem::path& file : files_in_no_line(ledger, root)) {
    records.damaged.push_back(unknown_record(file));
  }
  return records;
}

}  // namespace

std::filesystem::path qualification_folder(const std::filesystem::path& root) {
  return root / qualification_folder_name;
}

StationRecords read_station_records(const std::filesystem::path& root) {
  return further_station_records(root, {});
}

StationRecords further_station_records(const std::filesystem::path& root,
                                       const std::set<std::string>& known) {
  const LedgerReading reading(root);
  const Ledger ledger = read_ledger(root);
  std::vector<const LedgerLine*> lines = lines_of_records(ledger);
  std::erase_if(lines, [&](const LedgerLine* line) {
    return known.contains(std::filesystem::path(line->file).filename().string());
  });
  return records_of(root, ledger, lines);
}

StationRecords newest_station_records(const std::filesystem::path& root, const Ledger& ledger) {
  std::map<std::pair<std::string, std::string>, const LedgerLine*> newest;
  for (const LedgerLine* line : lines_of_records(ledger)) newest[{line->kind, line->of}] = line;
  std::vector<const LedgerLine*> lines;
  for (const auto& [told, line] : newest) lines.push_back(line);
  std::ranges::sort(lines, {}, &LedgerLine::number);
  return records_of(root, ledger, lines);
}

std::string self_test_kind(const std::string& rig_kind) {
  return std::string(self_test) + " of a rig of kind " + rig_kind;
}

std::string calibration_of(const std::string& channel) { return "calibration of " + channel; }

std::string calibration_kind(const std::string& channel, const std::string& certificate) {
  return calibration_of(channel) + " by " + certificate;
}

std::string keep_record(const std::filesystem::path& root, const CalibrationRecord& record) {
  return keep(root, calibration, calibration_kind(record.channel, record.certificate),
              record.station, record.entered_utc, to_json(record));
}

SelfTestRecord keep_begin(const std::filesystem::path& root, SelfTestRecord record) {
  record.passed = false;
  record.reason = "it has not come to its end";
  record.steps.clear();
  LedgerPen pen(root);
  record.file = new_name(root, self_test, record.utc);
  pen.keep(self_test_kind(record.rig_kind), record.station, below_root(record.file),
           json_text(to_json(record)));
  return record;
}

void keep_end(const std::filesystem::path& root, const SelfTestRecord& record) {
  const std::string kind = self_test_kind(record.rig_kind);
  LedgerPen pen(root);
  pen.keep(kind, record.station, below_root(record.file), json_text(to_json(record)));
  set_aside(pen, root, kind, record.station);
}

void take_back(const std::filesystem::path& root, const SelfTestRecord& begun) {
  LedgerPen(root).enter(set_aside_kind, begun.station, below_root(begun.file));
}

std::string keep_clock_record(const std::filesystem::path& root, const std::string& by) {
  const std::string utc = utc_now();
  return keep(root, clock, clock_kind, "", utc, {{"record", clock}, {"utc", utc}, {"by", by}});
}

}  // namespace rvbench::bench
