#include "bench/qualification/self_test_json.hpp"

#include <nlohmann/json.hpp>

#include "bench/examination_json.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

using Json = nlohmann::ordered_json;

SelfTestWord word_of(const std::string& text) {
  for (const SelfTestWord word :
       {SelfTestWord::passed, SelfTestWord::failed, SelfTestWord::skipped}) {
    if (text == to_string(word)) return word;
  }
  return SelfTestWord::cannot_tell;
}

Json json_of(const SelfTestReading& reading) {
  return hal::json_object({{"of", reading.of},
                           {"value", reading.value},
                           {"limit", reading.limit},
                           {"bound", reading.is_least ? "min" : "max"},
                           {"unit", reading.unit},
                           {"word", to_string(reading.word)}});
}

SelfTestReading reading_from_json(const Json& json) {
  return {.of = json.at("of").get<std::string>(),
          .value = number_or_nan(json.at("value")),
          .limit = number_or_nan(json.at("limit")),
          .is_least = json.at("bound") == "min",
          .unit = json.at("unit").get<std::string>(),
          .word = word_of(json.at("word").get<std::string>())};
}

}  // namespace

Json json_of(const std::vector<SelfTestResult>& steps) {
  Json all = Json::array();
  for (const SelfTestResult& step : steps) {
    Json readings = Json::array();
    for (const SelfTestReading& reading : step.readings) readings.push_back(json_of(reading));
    all.push_back(hal::json_object({{"step", step.step},
                                    {"word", to_string(step.word)},
                                    {"reason", step.reason},
                                    {"readings", std::move(readings)}}));
  }
  return all;
}

std::vector<SelfTestResult> self_test_from_json(const Json& json) {
  std::vector<SelfTestResult> steps;
  for (const Json& one : json) {
    SelfTestResult& step = steps.emplace_back();
    one.at("step").get_to(step.step);
    step.word = word_of(one.at("word").get<std::string>());
    one.at("reason").get_to(step.reason);
    for (const Json& reading : one.at("readings")) {
      step.readings.push_back(reading_from_json(reading));
    }
  }
  return steps;
}

}  // namespace rvbench::bench
