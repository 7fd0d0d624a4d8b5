#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "hal/drive.hpp"

/// Register words <-> physical values of the "rvbench generic inverter". Pure functions.
///
/// All registers are holding registers (functions 3, 6, 16); addresses are PDU addresses as on
/// the wire, 0-based: 0x0101 is what some manuals print as 4x0258.
///
///     0x0000  R   identity, always 0x5242
///     0x0001  R   pole pairs of the motor
///     0x0002  R   communication-loss time-out, 0.1 s; 0 = off
///     0x0003  R   communication-loss action: 0 ignore, 1 ramp to stop, 2 coast
///     0x0100  RW  command: bit 0 run forward, bit 1 run reverse, bit 7 fault reset (rising edge,
///                 only with bits 0 and 1 clear); 0 = ramp to stop. Both run bits: exception 3
///     0x0101  RW  frequency setpoint, magnitude, 0.01 Hz; above the drive's maximum: exception 3
///     0x0200  R   status: bit 0 output on, bit 1 tripped, bit 2 turning backwards; others clear
///     0x0201  R   output frequency, magnitude, 0.01 Hz
///     0x0202  R   motor current, 0.01 A
///     0x0203  R   estimated motor speed, 0.1 rpm, two's complement
///     0x0204  R   fault code, 0 = none
///
/// One request stays within one block (0x00.., 0x01.., 0x02..), else exception 2. A run command
/// while tripped: exception 4. A trip sets command and setpoint to 0. The watchdog runs while the
/// output is on; each valid request feeds it.
namespace rvbench::hal::inverter_registers {

struct Block {
  std::uint16_t address;
  std::uint16_t count;
};

inline constexpr Block settings{0x0000, 4};
inline constexpr Block command{0x0100, 2};
inline constexpr Block status{0x0200, 5};

using SettingsWords = std::array<std::uint16_t, settings.count>;
using CommandWords = std::array<std::uint16_t, command.count>;
using StatusWords = std::array<std::uint16_t, status.count>;

struct Settings {
  int pole_pairs = 0;
  DriveWatchdog watchdog;
};

/// Largest speed that 0x0203 can tell.
inline constexpr double max_speed_rpm = 3276.7;

inline constexpr CommandWords stop_words{0x0000, 0};
inline constexpr CommandWords reset_words{0x0080, 0};  ///< to be followed by stop_words

/// Command and setpoint for a signed motor speed without slip; standstill is a stop command.
/// @throws std::invalid_argument if the frequency does not fit into its register
CommandWords words_from_speed(double speed_rpm, int pole_pairs);

/// Empty if the words are not those of a generic inverter: identity, pole pairs, action.
std::optional<Settings> settings_from_words(const SettingsWords& words);

/// Empty if status bits are set that the drive never sets.
std::optional<DriveStatus> status_from_words(const StatusWords& words);

}  // namespace rvbench::hal::inverter_registers
