#include "bench/drive_section.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "hal/modbus/drive_profile_json.hpp"
#include "hal/steady_clock.hpp"

namespace rvbench::bench {
namespace {

hal::ModbusPath read_path(hal::ConfigReader& drive) {
  auto tcp = drive.optional_object("tcp");
  auto serial = drive.optional_object("serial");
  if (tcp.has_value() == serial.has_value()) {
    drive.fault("", R"(expected one of "tcp" and "serial": where the drive is)");
  }
  if (serial) {
    hal::ModbusRtu rtu;
    rtu.device = serial->text("device");
    rtu.baud = serial->integer("baud", {1200, 115200}, rtu.baud);
    rtu.parity = serial->choice("parity", {"N", "E", "O"}, "N").front();
    rtu.stop_bits = serial->integer("stop_bits", {1, 2}, rtu.stop_bits);
    return rtu;
  }
  hal::ModbusTcp path;
  if (!tcp) return path;
  path.host = tcp->text("host");
  path.port = static_cast<std::uint16_t>(tcp->integer("port", {1, 65535}, path.port));
  return path;
}

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
  options.path = read_path(drive);
  options.unit_id = static_cast<std::uint8_t>(drive.integer("unit_id", {1, 247}, options.unit_id));
  options.response_timeout_s =
      drive.number("response_timeout_s", {0.005, 2}, options.response_timeout_s);
  options.limits.max_speed_rpm = drive.number("max_speed_rpm", {1, 1e5});
  options.motor.pole_pairs = drive.integer("pole_pairs", {1, 50});
  options.motor.rated_Hz = drive.number("rated_Hz", {1, 1000}, options.motor.rated_Hz);
  if (rig.faults().size() > faults_before) return section;
  try {
    hal::SteadyClock clock;
    (void)hal::ModbusInverter(options, clock);  // opens nothing; knows what does not fit together
  } catch (const std::invalid_argument& error) {
    drive.fault("", error.what());
  }
  return section;
}

nlohmann::ordered_json to_json(const DriveSection& drive) {
  const hal::ModbusInverterOptions& options = drive.options;
  nlohmann::ordered_json json{{"profile", drive.profile}};
  if (const auto* tcp = std::get_if<hal::ModbusTcp>(&options.path)) {
    json["tcp"] = {{"host", tcp->host}, {"port", tcp->port}};
  } else {
    const auto& rtu = std::get<hal::ModbusRtu>(options.path);
    json["serial"] = {{"device", rtu.device},
                      {"baud", rtu.baud},
                      {"parity", std::string(1, rtu.parity)},
                      {"stop_bits", rtu.stop_bits}};
  }
  json["unit_id"] = options.unit_id;
  json["response_timeout_s"] = options.response_timeout_s;
  json["max_speed_rpm"] = options.limits.max_speed_rpm;
  json["pole_pairs"] = options.motor.pole_pairs;
  json["rated_Hz"] = options.motor.rated_Hz;
  return json;
}

std::string address_of(const DriveSection& drive) {
  const hal::ModbusInverterOptions& options = drive.options;
  if (const auto* tcp = std::get_if<hal::ModbusTcp>(&options.path)) {
    return fmt::format("{}:{}, unit {}", tcp->host, tcp->port, options.unit_id);
  }
  const auto& rtu = std::get<hal::ModbusRtu>(options.path);
  return fmt::format("{} at {} 8{}{}, unit {}", rtu.device, rtu.baud, rtu.parity, rtu.stop_bits,
                     options.unit_id);
}

}  // namespace rvbench::bench
