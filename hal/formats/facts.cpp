#include "hal/formats/facts.hpp"

#include <cmath>

#include "hal/formats/start_time.hpp"

namespace rvbench::hal::formats {
namespace {

constexpr double most_repeats = 1e6;

void state(Facts& facts, const char* name, double value) {
  if (std::isfinite(value)) facts.numbers[name] = value;
}

void state(Facts& facts, const char* name, const std::string& value) {
  if (!value.empty()) facts.texts[name] = value;
}

void take(const Facts& facts, const char* name, double& value) {
  const auto found = facts.numbers.find(name);
  if (found != facts.numbers.end() && std::isfinite(found->second)) value = found->second;
}

void take(const Facts& facts, const char* name, std::string& value) {
  const auto found = facts.texts.find(name);
  if (found != facts.texts.end()) value = found->second;
}

}  // namespace

Facts facts_of(const Recording& recording) {
  Facts facts;
  state(facts, "speed_rpm", recording.speed_rpm);
  state(facts, "planned_speed_rpm", recording.planned_speed_rpm);
  state(facts, "load_pct", recording.load_pct);
  state(facts, "torque_Nm", recording.torque_Nm);
  if (recording.repeat > 0) state(facts, "repeat", recording.repeat);
  state(facts, "rvbench_status", recording.status);
  state(facts, "start_time", utc_text(noted_start_s(recording)));
  return facts;
}

Facts facts_of(const Channel& channel) {
  Facts facts;
  if (channel.start_s != 0) state(facts, "start_s", channel.start_s);
  state(facts, "sensitivity", channel.info.sensitivity);
  state(facts, "time_uncertainty_s", channel.time_uncertainty_s);
  state(facts, "direction", channel.info.direction);
  return facts;
}

void apply(const Facts& facts, Recording& recording) {
  take(facts, "speed_rpm", recording.speed_rpm);
  take(facts, "planned_speed_rpm", recording.planned_speed_rpm);
  take(facts, "load_pct", recording.load_pct);
  take(facts, "torque_Nm", recording.torque_Nm);
  double repeat = recording.repeat;
  take(facts, "repeat", repeat);
  if (repeat >= 0 && repeat <= most_repeats) recording.repeat = static_cast<int>(repeat);
  // What a reader found wrong is not made right by what was so before.
  if (recording.status == "ok" || recording.status.empty()) {
    take(facts, "rvbench_status", recording.status);
    if (recording.status.empty()) recording.status = "ok";
  }
  std::string start;
  take(facts, "start_time", start);
  if (std::isnan(noted_start_s(recording))) note_start(utc_of_text(start), recording);
}

void apply(const Facts& facts, Channel& channel) {
  take(facts, "start_s", channel.start_s);
  take(facts, "sensitivity", channel.info.sensitivity);
  take(facts, "time_uncertainty_s", channel.time_uncertainty_s);
  take(facts, "direction", channel.info.direction);
}

}  // namespace rvbench::hal::formats
