#include "bench/qualification/qualification_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/json_text.hpp"
#include "bench/qualification/ages.hpp"
#include "bench/qualification/self_test_json.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

using Json = nlohmann::ordered_json;

Tone tone_of_word(SelfTestWord word) {
  if (word == SelfTestWord::passed) return Tone::good;
  return word == SelfTestWord::failed ? Tone::bad : Tone::warning;
}

std::string value_text(const SelfTestResult& step) {
  const SelfTestReading* worst = worst_reading(step);
  if (worst == nullptr || !std::isfinite(worst->value)) return "";
  return fmt::format("{:.3g} {} ({} {:.3g})", worst->value, worst->unit,
                     worst->is_least ? "min" : "max", worst->limit);
}

}  // namespace

std::string self_test_text(const Console& console, const SelfTestRecord& record) {
  std::string text;
  for (const SelfTestResult& step : record.steps) {
    text += fmt::format("  {}  {}  {}  {}\n", padded(step.step, 15),
                        paint(console, tone_of_word(step.word), padded(to_string(step.word), 11)),
                        padded(value_text(step), 24), step.reason);
  }
  const std::string answer =
      record.passed ? "Self-test passed." : "Self-test not passed: " + record.reason;
  return text + paint(console, record.passed ? Tone::good : Tone::bad, answer) + "\n";
}

std::string self_test_to_json(const SelfTestRecord& record, const Ending& ending, int exit_code) {
  const bool was_ended = ending.outcome != Outcome::pass;
  return json_text(
      hal::json_object({{"station", record.station},
                        {"utc", record.utc},
                        {"software", record.software},
                        {"passed", record.passed},
                        {"reason", record.reason},
                        {"ended", was_ended ? Json(to_string(ending.outcome)) : Json()},
                        {"steps", json_of(record.steps)},
                        {"exit_code", exit_code}}));
}

std::string qualification_text(const Console& console, const Qualification& qualification) {
  std::string text;
  for (const RequirementState& state : qualification.requirements) {
    const Tone tone = state.blocks              ? Tone::bad
                      : state.word == "expires" ? Tone::warning
                                                : Tone::good;
    text += "  " + paint(console, tone, padded(state.word, 9)) + "  " + state.sentence + "\n";
  }
  if (qualification.requirements.empty()) {
    return "Nothing is asked of this station: its rig file has no \"qualification\".\n";
  }
  const bool is_qualified = qualification.reasons().empty();
  return text +
         (is_qualified
              ? paint(console, Tone::good, "The station is qualified.")
              : paint(console, Tone::bad, "No unit can pass here before that is mended.")) +
         "\n";
}

std::string qualification_to_json(const Qualification& qualification, const std::string& station) {
  Json requirements = Json::array();
  for (const RequirementState& state : qualification.requirements) {
    requirements.push_back(hal::json_object({{"requirement", state.requirement},
                                             {"word", state.word},
                                             {"sentence", state.sentence},
                                             {"blocks", state.blocks}}));
  }
  const auto refusal = qualification.refusal();
  return json_text(hal::json_object({{"station", station},
                                     {"qualified", !refusal},
                                     {"requirements", std::move(requirements)},
                                     {"exit_code", refusal ? exit_code(*refusal) : 0}}));
}

std::string calibrations_text(const std::vector<CalibrationRecord>& records) {
  std::string text;
  for (const CalibrationRecord& record : records) {
    const std::string states = std::isfinite(record.sensitivity)
                                   ? fmt::format("{:.5g} V per unit", record.sensitivity)
                                   : "no sensitivity";
    text += fmt::format("  {}  {}  certificate {} of {}, {}, valid until {}, entered by {}\n",
                        padded(record.channel, 14), padded(record.station, 10), record.certificate,
                        day_of(record.calibrated_utc), states, day_of(record.valid_until_utc),
                        record.by);
  }
  return text.empty() ? "no calibration is on record\n" : text;
}

std::string calibrations_to_json(const std::vector<CalibrationRecord>& records) {
  Json all = Json::array();
  for (const CalibrationRecord& record : records) {
    all.push_back(hal::json_object({{"station", record.station},
                                    {"channel", record.channel},
                                    {"sensitivity", record.sensitivity},
                                    {"certificate", record.certificate},
                                    {"calibrated", day_of(record.calibrated_utc)},
                                    {"valid_until", day_of(record.valid_until_utc)},
                                    {"by", record.by},
                                    {"entered_utc", record.entered_utc},
                                    {"file", record.file}}));
  }
  return json_text(hal::json_object({{"calibrations", std::move(all)}}));
}

}  // namespace rvbench::bench
