#include "bench/factory/result_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/factory/file_uri.hpp"
#include "bench/json_text.hpp"
#include "bench/results/run_filter.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t digits_of_id = 32;
constexpr std::size_t digits_of_sum = 64;

// ResultEvaluationEnum, 10.3. An ERROR or ABORTED run says nothing of the unit.
int evaluation_of(Outcome outcome) {
  constexpr int undefined = 0, ok = 1, not_ok = 2, not_decidable = 3;
  switch (outcome) {
    case Outcome::pass: return ok;
    case Outcome::fail: return not_ok;
    case Outcome::invalid: return not_decidable;
    case Outcome::error:
    case Outcome::aborted: break;
  }
  return undefined;
}

// ResultState, 10.6: of the measurement, whatever it found.
int state_of(Outcome outcome) {
  constexpr int completed = 1, aborted = 3, failed = 4;
  if (outcome == Outcome::aborted) return aborted;
  return outcome == Outcome::error ? failed : completed;
}

// Of verdict.json, out of the list of hashes, which is small; "" if it is not there.
std::string sum_of_verdict(const std::filesystem::path& folder) {
  std::istringstream lines(read_file(folder / "SHA256SUMS").value_or(""));
  for (std::string line; std::getline(lines, line);) {
    if (line.size() > digits_of_sum && line.substr(digits_of_sum) == "  verdict.json") {
      return line.substr(0, digits_of_sum);
    }
  }
  return "";
}

// Whether it was a simulated bench or a replay; nothing if the run does not say.
Json is_simulated(const std::filesystem::path& folder) {
  const Json rig = ordered_json_or_discarded(read_file(folder / "rig.json").value_or(""));
  if (!rig.is_object() || !rig.contains("rig") || !rig["rig"].is_string()) return nullptr;
  return rig["rig"] != "bench";
}

Json id_of_file(const std::filesystem::path& file) {
  const auto sum = sha256_of_file(file);
  return sum ? Json("sha256:" + *sum) : Json();
}

Json uris_of(const std::filesystem::path& folder) {
  Json uris = Json::array();
  for (const char* name : {"verdict.json", "report.html", "recording.h5"}) {
    std::error_code unknown;
    if (std::filesystem::exists(folder / name, unknown)) uris.push_back(file_uri(folder / name));
  }
  return uris;
}

Json processing_times(const std::string& started, const std::string& judged) {
  if (started.empty() || judged.empty()) return nullptr;
  return hal::json_object({{"StartTime", started}, {"EndTime", judged}});
}

Json meta_data(const std::filesystem::path& folder, const std::string& job,
               const Judgement& judgement, const std::string& step) {
  const Ending& ending = judgement.ending;
  const std::string judged = iso_utc(judgement.facts.judged_utc);
  Json meta = hal::json_object(
      {{"ResultId", ""},  // the caller's
       {"HasTransferableDataOnFile", false},
       {"IsPartial", false},
       {"IsSimulated", is_simulated(folder)},
       {"ResultState", state_of(ending.outcome)},
       {"StepId", json_or_null(step)},
       {"PartId", judgement.facts.serial},
       {"ExternalRecipeId", json_or_null(judgement.facts.plan)},
       {"InternalRecipeId", id_of_file(folder / "plan.json")},
       {"ProductId", json_or_null(judgement.machine)},
       {"InternalConfigurationId", id_of_file(folder / "rig.json")},
       {"JobId", job},
       {"CreationTime", json_or_null(judged)},
       {"ProcessingTimes", processing_times(iso_utc(judgement.facts.started_utc), judged)},
       {"ResultUri", uris_of(folder)},
       {"ResultEvaluation", evaluation_of(ending.outcome)},
       {"ResultEvaluationCode", exit_code(ending)},
       {"ResultEvaluationDetails", hal::json_object({{"Locale", "en"}, {"Text", ending.reason}})}});
  // All but ResultId are optional: what is not known is not there.
  for (auto field = meta.begin(); field != meta.end();) {
    field = field->is_null() ? meta.erase(field) : std::next(field);
  }
  return meta;
}

Json picked(const Json& from, std::initializer_list<const char*> keys) {
  Json some = Json::object();
  for (const char* key : keys) {
    if (from.contains(key)) some[key] = from[key];
  }
  return some;
}

Json content_of(const Json& verdict) {
  Json content =
      picked(verdict, {"verdict", "reason", "exit_code", "error_kind", "findings", "findings_stand",
                       "quality", "limits", "machine", "software", "seed"});
  content["points"] = Json::array();
  for (const Json& point : verdict.at("points")) {
    Json& told = content["points"].emplace_back(
        picked(point, {"status", "source", "planned_speed_rpm", "speed_rpm", "load_pct", "repeat",
                       "torque_Nm", "indicators"}));
    told["channels"] = Json::array();
    for (const Json& channel : point.at("channels")) {
      told["channels"].push_back(
          picked(channel, {"name", "unit", "rms", "peak", "kurtosis", "indicators"}));
    }
  }
  return content;
}

}  // namespace

std::string result_id_of(const std::filesystem::path& root, const std::filesystem::path& folder) {
  const std::string sum = sum_of_verdict(folder);
  if (sum.empty()) return "";
  return sha256_of_text(folder.lexically_relative(root).string() + "\n" + sum)
      .substr(0, digits_of_id);
}

Result<OutboxEntry> result_message(const std::filesystem::path& root,
                                   const std::filesystem::path& folder, const std::string& step) {
  const std::string text = read_file(folder / "verdict.json").value_or("");
  const auto judgement = judgement_from_json(text);
  if (!judgement) return IoError{IoErrc::bad_data, "its verdict.json is damaged"};
  if (sha256_of_text(text) != sum_of_verdict(folder)) {
    return IoError{IoErrc::bad_data, "its verdict.json does not match its hash"};
  }
  const std::string job = folder.lexically_relative(root).string();
  OutboxEntry due{.result_id = result_id_of(root, folder), .folder = job, .payload = ""};
  Json meta = meta_data(folder, job, *judgement, step);
  meta["ResultId"] = due.result_id;
  const Json content = content_of(parse_ordered_json(text));
  due.payload = json_line(
      hal::json_object({{"ResultMetaData", meta}, {"ResultContent", Json::array({content})}}));
  return due;
}

std::string payload_to_send(const OutboxEntry& due) {
  Json payload = parse_ordered_json(due.payload);
  payload["PossibleDuplicate"] = due.sends > 0;
  return json_line(payload);
}

}  // namespace rvbench::bench
