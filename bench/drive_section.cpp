#include "bench/drive_section.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/misfit.hpp"
#include "bench/modbus_path_section.hpp"
#include "hal/json_object.hpp"
#include "hal/modbus/drive_profile_json.hpp"
#include "hal/steady_clock.hpp"

namespace rvbench::bench {
namespace {

void read_profile(hal::ConfigReader& drive, DriveSection& section) {
  section.profile = drive.text("profile");
  if (section.profile.empty()) return;  // missing: already a fault
  auto profile = hal::read_drive_profile(section.profile);
  if (profile.index() == 0) {
    section.options.profile = std::get<0>(std::move(profile));
    return;
  }
  for (const hal::ConfigFault& fault : std::get<1>(profile)) {
    drive.fault("profile", hal::describe(section.profile, fault));
  }
}

}  // namespace

DriveSection read_drive_section(hal::ConfigReader& rig) {
  DriveSection section;
  hal::ModbusInverterOptions& options = section.options;
  hal::ConfigReader drive = rig.object("drive");
  const std::size_t faults_before = rig.faults().size();
  read_profile(drive, section);
  options.path = read_modbus_path(drive, "the drive");
  options.unit_id = static_cast<std::uint8_t>(drive.integer("unit_id", {1, 247}, options.unit_id));
  options.response_timeout_s = drive.number(
      "response_timeout_s", {0.005, longest_response_timeout_s}, options.response_timeout_s);
  options.limits.max_speed_rpm = drive.number("max_speed_rpm", {1, 1e5});
  options.motor.pole_pairs = drive.integer("pole_pairs", {1, 50});
  options.motor.rated_Hz = drive.number("rated_Hz", {1, 1000}, options.motor.rated_Hz);
  if (rig.faults().size() > faults_before) return section;
  try {
    hal::SteadyClock clock;
    (void)hal::ModbusInverter(options, clock);  // opens nothing; knows what does not fit together
  } catch (const std::invalid_argument& error) {
    note_misfit(drive, "max_speed_rpm", error);  // the rest was looked at above
  }
  return section;
}

nlohmann::ordered_json to_json(const DriveSection& drive) {
  const hal::ModbusInverterOptions& options = drive.options;
  nlohmann::ordered_json json = hal::json_object({{"profile", drive.profile}});
  add_modbus_path(json, options.path);
  json["unit_id"] = options.unit_id;
  json["response_timeout_s"] = options.response_timeout_s;
  json["max_speed_rpm"] = options.limits.max_speed_rpm;
  json["pole_pairs"] = options.motor.pole_pairs;
  json["rated_Hz"] = options.motor.rated_Hz;
  return json;
}

std::string address_of(const DriveSection& drive) {
  const hal::ModbusInverterOptions& options = drive.options;
  return fmt::format("{}, unit {}", shown(options.path), options.unit_id);
}

}  // namespace rvbench::bench
