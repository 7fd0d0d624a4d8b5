#include "bench/verdict_json.hpp"

#include <nlohmann/json.hpp>
#include <string_view>

#include "bench/command.hpp"
#include "bench/examination_json.hpp"
#include "bench/findings_stand.hpp"
#include "bench/json_text.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

// What is not stated is null: json_or_null() writes it.
std::string text_or_empty(const nlohmann::ordered_json& json, const char* key) {
  const auto found = json.find(key);
  return found == json.end() || found->is_null() ? "" : found->get<std::string>();
}

std::optional<double> number_if_there(const nlohmann::ordered_json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || found->is_null()) return std::nullopt;
  return found->get<double>();
}

nlohmann::ordered_json to_json(const RunFacts& facts) {
  nlohmann::ordered_json events = nlohmann::ordered_json::array();
  for (const auto& [time_s, text] : facts.events)
    events.push_back(hal::json_object({{"time_s", time_s}, {"event", text}}));
  nlohmann::ordered_json json =
      hal::json_object({{"serial", facts.serial},
                        {"started_utc", facts.started_utc},
                        {"judged_utc", json_or_null(facts.judged_utc)},
                        {"plan", facts.plan},
                        {"limits_version", json_or_null(facts.limits_version)},
                        {"rig", facts.rig},
                        {"preset", facts.preset},
                        {"duration_s", facts.duration_s},
                        {"drive_retries", facts.drive_retries},
                        {"shaft_stopped", facts.shaft_stopped},
                        {"brake_released", facts.brake_released},
                        {"resumed_at_point", nullptr},
                        {"events", events}});
  if (facts.resumed_at_point) json["resumed_at_point"] = *facts.resumed_at_point;
  return json;
}

RunFacts facts_from_json(const nlohmann::ordered_json& json) {
  RunFacts facts;
  json.at("serial").get_to(facts.serial);
  json.at("started_utc").get_to(facts.started_utc);
  facts.judged_utc = text_or_empty(json, "judged_utc");  // of an older rvbench absent
  json.at("plan").get_to(facts.plan);
  facts.limits_version = text_or_empty(json, "limits_version");
  json.at("rig").get_to(facts.rig);
  json.at("preset").get_to(facts.preset);
  facts.duration_s = number_or_nan(json.at("duration_s"));
  json.at("drive_retries").get_to(facts.drive_retries);
  json.at("shaft_stopped").get_to(facts.shaft_stopped);
  json.at("brake_released").get_to(facts.brake_released);
  if (!json.at("resumed_at_point").is_null())
    facts.resumed_at_point = json["resumed_at_point"].get<int>();
  for (const auto& event : json.at("events")) {
    facts.events.emplace_back(number_or_nan(event.at("time_s")),
                              event.at("event").get<std::string>());
  }
  return facts;
}

nlohmann::ordered_json to_json(const LimitCheck& check) {
  return hal::json_object({{"measure", check.measure},
                           {"component", json_or_null(check.component)},
                           {"unit", check.unit},
                           {"max", check.max},
                           {"measured", check.measured},
                           {"where", json_or_null(check.where)},
                           {"passed", check.passed},
                           {"why", check.why},
                           {"of", json_or_null(check.of)},
                           {"min", check.min},
                           {"points", check.points},
                           {"not_measured_at", check.lacking},
                           {"speed_rpm", json_or_null(check.at.speed_rpm)},
                           {"load_pct", json_or_null(check.at.load_pct)}});
}

LimitCheck limit_from_json(const nlohmann::ordered_json& json) {
  LimitCheck check;
  json.at("measure").get_to(check.measure);
  check.component = text_or_empty(json, "component");
  json.at("unit").get_to(check.unit);
  check.max = number_or_nan(json.at("max"));
  check.measured = number_or_nan(json.at("measured"));
  check.where = text_or_empty(json, "where");
  json.at("passed").get_to(check.passed);
  json.at("why").get_to(check.why);
  // Keys that may be absent: of anything, at all points, not bounded from below, measured wherever
  // it was asked.
  check.of = text_or_empty(json, "of");
  check.min = number_or_nan(json.value("min", nlohmann::ordered_json()));
  check.points = json.value("points", check.points);
  check.lacking = json.value("not_measured_at", check.lacking);
  check.at = {number_if_there(json, "speed_rpm"), number_if_there(json, "load_pct")};
  return check;
}

nlohmann::ordered_json to_json(const JudgedPoint& point) {
  nlohmann::ordered_json json =
      hal::json_object({{"status", point.status},
                        {"planned_speed_rpm", point.planned_speed_rpm},
                        {"torque_Nm", point.torque_Nm},
                        {"acceleration_time_uncertainty_s", point.acceleration_time_uncertainty_s},
                        {"torque_time_uncertainty_s", point.torque_time_uncertainty_s}});
  json.update(json_of(point.examination));
  return json;
}

JudgedPoint point_from_json(const nlohmann::ordered_json& json) {
  JudgedPoint point;
  json.at("status").get_to(point.status);
  point.planned_speed_rpm = number_or_nan(json.at("planned_speed_rpm"));
  point.torque_Nm = number_or_nan(json.at("torque_Nm"));
  const nlohmann::ordered_json unknown;  // these keys may be absent
  point.acceleration_time_uncertainty_s =
      number_or_nan(json.value("acceleration_time_uncertainty_s", unknown));
  point.torque_time_uncertainty_s = number_or_nan(json.value("torque_time_uncertainty_s", unknown));
  point.examination = examination_from_json(json);
  return point;
}

Ending ending_from_json(const nlohmann::ordered_json& json) {
  Ending ending;
  for (const Outcome outcome : all_outcomes) {
    if (json.at("verdict") == to_string(outcome)) ending.outcome = outcome;
  }
  for (const ErrorKind kind : {ErrorKind::none, ErrorKind::device_lost, ErrorKind::safety_trip,
                               ErrorKind::not_qualified}) {
    if (json.at("error_kind") == to_string(kind)) ending.error_kind = kind;
  }
  json.at("reason").get_to(ending.reason);
  return ending;
}

Judgement parsed(const nlohmann::ordered_json& json) {
  Judgement judgement;
  judgement.ending = ending_from_json(json);
  judgement.facts = facts_from_json(json.at("run"));
  json.at("software").get_to(judgement.facts.software);
  if (!json.at("seed").is_null()) judgement.facts.seed = json["seed"].get<std::uint64_t>();
  json.at("machine").get_to(judgement.machine);
  judgement.diagnosis = diagnosis_from_json(json);
  for (const auto& check : json.at("limits")) judgement.limits.push_back(limit_from_json(check));
  for (const auto& point : json.at("points")) judgement.points.push_back(point_from_json(point));
  return judgement;
}

// Only a finding that stands, above its limit, is one to be sure of and to act upon.
void withdraw_advice(nlohmann::ordered_json& json, bool stand) {
  json["findings_stand"] = stand;
  for (const char* list : {"findings", "below_limit", "not_shown"}) {
    if (stand && list == std::string_view("findings")) continue;
    for (nlohmann::ordered_json& hypothesis : json[list]) {
      hypothesis["confidence"] = 0;
      hypothesis["advice"] = "";
    }
  }
}

}  // namespace

std::string refusal_to_json(int exit_code, const std::vector<std::string>& complaints) {
  std::string reason;
  for (const std::string& line : complaints) reason += (reason.empty() ? "" : "\n") + line;
  nlohmann::ordered_json json = hal::json_object({{"verdict", nullptr},
                                                  {"reason", reason},
                                                  {"exit_code", exit_code},
                                                  {"error_kind", to_string(ErrorKind::none)}});
  if (exit_code == exit_codes::data_refused) json["verdict"] = to_string(Outcome::invalid);
  return json_text(json);
}

std::string judgement_to_json(const Judgement& judgement) {
  nlohmann::ordered_json json =
      hal::json_object({{"verdict", to_string(judgement.ending.outcome)},
                        {"reason", judgement.ending.reason},
                        {"exit_code", exit_code(judgement.ending)},
                        {"error_kind", to_string(judgement.ending.error_kind)}});
  json.update(json_of(judgement.diagnosis));
  withdraw_advice(json, findings_stand(judgement));
  json["machine"] = judgement.machine;
  json["software"] = judgement.facts.software;
  json["seed"] = nullptr;
  if (judgement.facts.seed) json["seed"] = *judgement.facts.seed;
  json["run"] = to_json(judgement.facts);
  json["limits"] = nlohmann::ordered_json::array();
  for (const LimitCheck& check : judgement.limits) json["limits"].push_back(to_json(check));
  json["points"] = nlohmann::ordered_json::array();
  for (const JudgedPoint& point : judgement.points) json["points"].push_back(to_json(point));
  return json_text(json);
}

std::optional<Judgement> judgement_from_json(const std::string& text) {
  try {
    return parsed(parse_ordered_json(text));
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

std::optional<Judgement> judgement_in(const std::filesystem::path& run) {
  if (!matches_sum(run, "verdict.json")) return std::nullopt;
  return judgement_from_json(read_file(run / "verdict.json").value_or(""));
}

}  // namespace rvbench::bench
