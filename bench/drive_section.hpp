#pragma once

#include <nlohmann/json_fwd.hpp>

#include "hal/config_reader.hpp"
#include "hal/modbus/modbus_inverter.hpp"

namespace rvbench::bench {

/// What a rig file says of its drive:
///
///     "drive": {"profile": "delta_ms300", "tcp": {"host": "192.168.3.10", "port": 502},
///               "unit_id": 1, "max_speed_rpm": 1900, "pole_pairs": 2, "rated_Hz": 50,
///               "response_timeout_s": 0.1}
///
/// with `"serial": {"device": "/dev/ttyUSB0", "baud": 9600, "parity": "N", "stop_bits": 1}` in
/// place of "tcp" where it is on a serial line.
struct DriveSection {
  std::string profile;  ///< built in, or a file
  hal::ModbusInverterOptions options;
};

/// Faults are noted at `rig`.
DriveSection read_drive_section(hal::ConfigReader& rig);

/// With every default spelled out.
nlohmann::ordered_json to_json(const DriveSection& drive);

/// "192.168.3.10:502, unit 1" or "/dev/ttyUSB0 at 9600 8N1, unit 1"
std::string address_of(const DriveSection& drive);

}  // namespace rvbench::bench
