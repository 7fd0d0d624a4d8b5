#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/inverter_model.hpp"

namespace rvbench::sim {

/// What the drive answers to a request that it does not carry out: Modbus exception codes.
enum class TableAnswer : std::uint8_t {
  done = 0,
  illegal_address = 2,
  illegal_value = 3,
  device_failure = 4  ///< a run was asked for while tripped
};

/// The holding registers of the simulated drive, read from the prose of its manual:
///
///     0x0000  identity, always 0x5242          0x0200  status: bit 0 output on, bit 1 tripped,
///     0x0001  pole pairs of the motor                  bit 2 turning backwards, bit 3 obeys its
///                                                      panel: commands are not followed
///     0x0002  comm-loss time-out, 0.1 s        0x0201  output frequency, magnitude, 0.01 Hz
///     0x0003  comm-loss action: 0 ignore,      0x0202  motor current, 0.01 A
///             1 ramp to stop, 2 coast          0x0203  motor speed, 0.1 rpm, two's complement
///     0x0100  command: bit 0 run forward,      0x0204  fault code, 0 = none
///             bit 1 run reverse, bit 7 reset
///     0x0101  frequency setpoint, 0.01 Hz      only 0x0100 and 0x0101 can be written
///
/// A request must stay within one of the three blocks.
std::optional<std::vector<std::uint16_t>> read_table(const InverterModel& model,
                                                     std::uint16_t address, std::uint16_t count);

/// Carries out a write of one or both command registers, as a whole or not at all.
TableAnswer write_table(InverterModel& model, std::uint16_t address,
                        const std::vector<std::uint16_t>& values);

}  // namespace rvbench::sim
