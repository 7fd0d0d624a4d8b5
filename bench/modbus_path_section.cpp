#include "bench/modbus_path_section.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "hal/did_you_mean.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

// libmodbus sets any other to 9600.
constexpr std::array bauds{1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200};

bool is_address(const std::string& host) {
  in_addr address{};
  return ::inet_pton(AF_INET, host.c_str(), &address) == 1;
}

hal::ModbusRtu read_rtu(hal::ConfigReader& serial) {
  hal::ModbusRtu rtu;
  rtu.device = serial.text("device");
  rtu.baud = serial.integer("baud", {1200, 115200}, rtu.baud);
  if (std::ranges::find(bauds, rtu.baud) == bauds.end()) {
    serial.fault("baud",
                 fmt::format("{} is no rate of a Modbus line, such as 9600 or 19200", rtu.baud));
  }
  rtu.parity = serial.choice("parity", {"N", "E", "O"}, "N").front();
  rtu.stop_bits = serial.integer("stop_bits", {1, 2}, rtu.stop_bits);
  return rtu;
}

hal::ModbusTcp read_tcp(hal::ConfigReader& tcp) {
  hal::ModbusTcp path;
  const std::size_t faults_before = tcp.faults().size();
  path.host = tcp.text("host");
  if (tcp.faults().size() == faults_before && !is_address(path.host)) {
    tcp.fault("host", hal::in_quotes(path.host) + " is not an IPv4 address");
  }
  path.port = static_cast<std::uint16_t>(tcp.integer("port", {1, 65535}, path.port));
  return path;
}

}  // namespace

hal::ModbusPath read_modbus_path(hal::ConfigReader& section, const std::string& what) {
  auto tcp = section.optional_object("tcp");
  auto serial = section.optional_object("serial");
  if (tcp.has_value() == serial.has_value()) {
    section.fault("", "expected one of \"tcp\" and \"serial\": where " + what + " is");
  }
  hal::ModbusPath path;
  if (tcp) path = read_tcp(*tcp);
  if (serial) path = read_rtu(*serial);
  return path;
}

void add_modbus_path(nlohmann::ordered_json& section, const hal::ModbusPath& path) {
  if (const auto* tcp = std::get_if<hal::ModbusTcp>(&path)) {
    section["tcp"] = hal::json_object({{"host", tcp->host}, {"port", tcp->port}});
    return;
  }
  const auto& rtu = std::get<hal::ModbusRtu>(path);
  section["serial"] = hal::json_object({{"device", rtu.device},
                                        {"baud", rtu.baud},
                                        {"parity", std::string(1, rtu.parity)},
                                        {"stop_bits", rtu.stop_bits}});
}

std::string shown(const hal::ModbusPath& path) {
  if (const auto* tcp = std::get_if<hal::ModbusTcp>(&path)) {
    return fmt::format("{}:{}", tcp->host, tcp->port);
  }
  const auto& rtu = std::get<hal::ModbusRtu>(path);
  return fmt::format("{} at {} 8{}{}", rtu.device, rtu.baud, rtu.parity, rtu.stop_bits);
}

}  // namespace rvbench::bench
