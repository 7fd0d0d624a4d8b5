#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "hal/config_reader.hpp"
#include "hal/modbus/modbus_path.hpp"

namespace rvbench::bench {

/// A stop of the shaft waits for the reply that is under way.
inline constexpr double longest_response_timeout_s = 0.3;

/// Reads where a Modbus device is: one of `"tcp": {"host": ..., "port": 502}` and `"serial":
/// {"device": ..., "baud": 9600, "parity": "N", "stop_bits": 1}`. Faults are noted at `section`.
/// @param what  that is looked for: "the drive"
hal::ModbusPath read_modbus_path(hal::ConfigReader& section, const std::string& what);

/// Adds the one key to a section, with every default spelled out.
void add_modbus_path(nlohmann::ordered_json& section, const hal::ModbusPath& path);

/// "192.168.3.10:502" or "/dev/ttyUSB0 at 9600 8N1"
std::string shown(const hal::ModbusPath& path);

}  // namespace rvbench::bench
