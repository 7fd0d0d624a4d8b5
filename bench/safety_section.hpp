#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "hal/config_reader.hpp"
#include "hal/modbus/modbus_safety_inputs.hpp"

namespace rvbench::bench {

/// What a rig file says of its safety inputs, on a Modbus coupler:
///
///     "safety": {"tcp": {"host": "192.168.3.20", "port": 502}, "unit_id": 1,
///                "estop": {"input": 0, "closed": 1}, "guard": {"input": 1, "closed": 1},
///                "temperature": {"input_register": 0, "signed": true, "scale_degC": 0.1,
///                                "offset_degC": 0, "min_degC": -40, "max_degC": 200},
///                "response_timeout_s": 0.1, "period_s": 0.01, "deadline_s": 0.2}
///
/// with "serial" in place of "tcp" as the drive's, and "holding_register" in place of
/// "input_register". Addresses are those of the wire, from 0. `closed` is what the input reads
/// while the contact is closed, which is safe; with 1 a broken wire reads as an open chain.
struct SafetySection {
  hal::ModbusSafetyOptions options;
};

/// Faults are noted at `safety`.
SafetySection read_safety_section(hal::ConfigReader& safety);

/// With every default spelled out.
nlohmann::ordered_json to_json(const SafetySection& safety);

/// What of it runs, and better would not: a contact whose broken wire reads as safe. Pointers are
/// those of the rig file.
std::vector<hal::ConfigFault> warnings_of(const SafetySection& safety);

/// "192.168.3.20:502, unit 1"
std::string address_of(const SafetySection& safety);

}  // namespace rvbench::bench
