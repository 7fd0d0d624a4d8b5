#include "bench/safety_section.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/misfit.hpp"
#include "bench/modbus_path_section.hpp"
#include "hal/json_object.hpp"
#include "hal/steady_clock.hpp"

namespace rvbench::bench {
namespace {

constexpr hal::Bounds addresses{0, 65535};

hal::SafetyContact read_contact(hal::ConfigReader& contact, const hal::SafetyContact& fallback) {
  return {.address = static_cast<std::uint16_t>(contact.integer("input", addresses)),
          .closed = contact.integer("closed", {0, 1}, fallback.closed ? 1 : 0) == 1};
}

hal::TemperatureRegister read_temperature(hal::ConfigReader temperature) {
  hal::TemperatureRegister at;
  at.is_holding = temperature.has("holding_register");
  if (at.is_holding == temperature.has("input_register")) {
    temperature.fault("", R"(expected one of "input_register" and "holding_register")");
    return at;
  }
  at.address = static_cast<std::uint16_t>(
      temperature.integer(at.is_holding ? "holding_register" : "input_register", addresses));
  at.is_signed = temperature.boolean("signed", at.is_signed);
  at.scale_degC = temperature.number("scale_degC", {-100, 100}, at.scale_degC);
  at.offset_degC = temperature.number("offset_degC", {-1e4, 1e4}, at.offset_degC);
  at.min_degC = temperature.number("min_degC", {-273.15, 1000}, at.min_degC);
  at.max_degC = temperature.number("max_degC", {-273.15, 1000}, at.max_degC);
  if (at.scale_degC == 0) temperature.fault("scale_degC", "0 makes one temperature of them all");
  if (!(at.min_degC < at.max_degC)) {
    temperature.fault(
        temperature.has("max_degC") ? "max_degC" : "min_degC",
        fmt::format("no temperature is within {:g} to {:g} degC", at.min_degC, at.max_degC));
  }
  return at;
}

nlohmann::ordered_json to_json(const hal::SafetyContact& contact) {
  return hal::json_object({{"input", contact.address}, {"closed", contact.closed ? 1 : 0}});
}

}  // namespace

SafetySection read_safety_section(hal::ConfigReader& safety) {
  SafetySection section;
  hal::ModbusSafetyOptions& options = section.options;
  const std::size_t faults_before = safety.faults().size();
  options.path = read_modbus_path(safety, "the coupler");
  options.unit_id = static_cast<std::uint8_t>(safety.integer("unit_id", {0, 255}, options.unit_id));
  hal::ConfigReader estop = safety.object("estop");
  hal::ConfigReader guard = safety.object("guard");
  options.estop = read_contact(estop, options.estop);
  options.guard = read_contact(guard, options.guard);
  options.temperature = read_temperature(safety.object("temperature"));
  options.response_timeout_s = safety.number(
      "response_timeout_s", {0.005, longest_response_timeout_s}, options.response_timeout_s);
  options.period_s = safety.number("period_s", {0.001, 0.1}, options.period_s);
  options.deadline_s = safety.number("deadline_s", {0.02, 2}, options.deadline_s);
  if (safety.faults().size() > faults_before) return section;
  if (options.guard.address == options.estop.address) {
    guard.fault("input", "emergency stop and guard are on one input");
    return section;
  }
  try {
    const hal::SteadyClock clock;
    (void)hal::ModbusSafetyInputs(options, clock);  // opens nothing
  } catch (const std::invalid_argument& error) {
    note_misfit(guard, "input", error);  // too far from the emergency stop's
  }
  return section;
}

nlohmann::ordered_json to_json(const SafetySection& safety) {
  const hal::ModbusSafetyOptions& options = safety.options;
  const hal::TemperatureRegister& at = options.temperature;
  nlohmann::ordered_json json;
  add_modbus_path(json, options.path);
  json["unit_id"] = options.unit_id;
  json["estop"] = to_json(options.estop);
  json["guard"] = to_json(options.guard);
  json["temperature"] = {{at.is_holding ? "holding_register" : "input_register", at.address},
                         {"signed", at.is_signed},
                         {"scale_degC", at.scale_degC},
                         {"offset_degC", at.offset_degC},
                         {"min_degC", at.min_degC},
                         {"max_degC", at.max_degC}};
  json["response_timeout_s"] = options.response_timeout_s;
  json["period_s"] = options.period_s;
  json["deadline_s"] = options.deadline_s;
  return json;
}

std::vector<hal::ConfigFault> warnings_of(const SafetySection& safety) {
  std::vector<hal::ConfigFault> warnings;
  const auto look_at = [&](const char* key, const hal::SafetyContact& contact, const char* safe) {
    if (contact.closed) return;
    warnings.push_back({0, fmt::format("/safety/{}/closed", key),
                        fmt::format("with 0 a broken wire, or a coupler without supply, reads as "
                                    "{}; use a contact that opens, and 1",
                                    safe)});
  };
  look_at("estop", safety.options.estop, "not pressed");
  look_at("guard", safety.options.guard, "shut");
  return warnings;
}

std::string address_of(const SafetySection& safety) {
  return fmt::format("{}, unit {}", shown(safety.options.path), safety.options.unit_id);
}

}  // namespace rvbench::bench
