#include "bench/qualification/station_records.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "bench/examination_json.hpp"
#include "bench/json_text.hpp"
#include "bench/on_disk.hpp"
#include "bench/qualification/self_test_json.hpp"
#include "bench/results/run_filter.hpp"
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
  return {{"record", self_test},           {"station", record.station}, {"utc", record.utc},
          {"software", record.software},   {"passed", record.passed},   {"reason", record.reason},
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
std::string take(StationRecords& records, const std::filesystem::path& file) {
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

std::string keep(const std::filesystem::path& root, const std::string& kind, const std::string& utc,
                 const Json& json) {
  const std::filesystem::path folder = qualification_folder(root);
  std::filesystem::create_directories(folder);
  std::string name = kind + "-" + utc + suffix;
  for (int copy = 2; std::filesystem::exists(folder / name); ++copy) {
    name = kind + "-" + utc + "-" + std::to_string(copy) + suffix;
  }
  write_file(folder / name, json_text(json));
  put_folder_on_disk(folder);
  return name;
}

}  // namespace

std::filesystem::path qualification_folder(const std::filesystem::path& root) {
  return root / "qualification";
}

StationRecords read_station_records(const std::filesystem::path& root) {
  StationRecords records;
  std::vector<std::filesystem::path> files;
  std::error_code error;  // what cannot be looked into holds none
  using Entries = std::filesystem::directory_iterator;
  for (Entries entry(qualification_folder(root), error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().extension() == suffix) files.push_back(entry->path());
  }
  // Of several in one second the names grow: "...Z.json", "...Z-2.json".
  std::ranges::sort(files, {}, [](const std::filesystem::path& file) {
    const std::string name = file.filename().string();
    return std::pair(name.size(), name);
  });
  for (const std::filesystem::path& file : files) {
    const std::string why = take(records, file);
    if (!why.empty()) records.damaged.push_back(file.string() + " is damaged: " + why);
  }
  std::ranges::stable_sort(records.calibrations, {}, &CalibrationRecord::entered_utc);
  std::ranges::stable_sort(records.self_tests, {}, &SelfTestRecord::utc);
  return records;
}

std::string keep_record(const std::filesystem::path& root, const CalibrationRecord& record) {
  return keep(root, calibration, record.entered_utc, to_json(record));
}

std::string keep_record(const std::filesystem::path& root, const SelfTestRecord& record) {
  return keep(root, self_test, record.utc, to_json(record));
}

}  // namespace rvbench::bench
