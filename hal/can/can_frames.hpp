#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hal/can_transport.hpp"

/// CAN frames <-> physical values of transducer and brake. Pure functions.
///
/// All numbers are sent least significant byte first; 11-bit identifiers.
///
///     0x181  transducer -> bench  int32 torque, µN·m; uint16 angle, 65536 counts per turn;
///                                 uint8 rolling counter; uint8 status: bit 0 zeroing,
///                                 bit 1 overload, bit 2 shunt on
///     0x201  bench -> brake       uint16 torque setpoint, 0.1 N·m; uint8 enable (0 or 1);
///                                 uint8 rolling counter
///     0x281  brake -> bench       uint16 torque, 0.1 N·m; uint8 state: bit 0 engaged,
///                                 bit 1 tripped, bit 2 command lost; uint8 rolling counter
///
/// The brake releases by itself when commands stop coming; it engages again only after a command
/// with enable = 0. The torque frame is that of common rotating transducers with CANopen (one
/// TPDO with an int32), widened by angle and counter.
namespace rvbench::hal::can_frames {

inline constexpr std::uint32_t torque_id = 0x181;
inline constexpr std::uint32_t brake_command_id = 0x201;
inline constexpr std::uint32_t brake_status_id = 0x281;
inline constexpr double max_brake_torque_Nm = 6553.5;  ///< largest setpoint that a frame can tell

struct TorqueFrame {
  double torque_Nm = 0;
  double angle_turns = 0;  ///< within [0, 1)
  std::uint8_t counter = 0;
  bool zeroing = false;
  bool overload = false;
  bool shunt_on = false;
  std::string flaw = {};  ///< whatever else it says is wrong: "State: not calibrated"

  bool operator==(const TorqueFrame&) const = default;
};

struct BrakeCommandFrame {
  double torque_Nm = 0;
  bool enable = false;
  std::uint8_t counter = 0;
};

struct BrakeStatusFrame {
  double torque_Nm = 0;
  bool engaged = false;
  bool tripped = false;
  bool command_lost = false;
  std::uint8_t counter = 0;
};

/// Empty if identifier or length are not those of the frame, or if bits are set that it never sets.
std::optional<TorqueFrame> torque_from_frame(const CanFrame& frame);
std::optional<BrakeStatusFrame> brake_status_from_frame(const CanFrame& frame);

/// @throws std::invalid_argument if torque_Nm is not within [0, max_brake_torque_Nm]
CanFrame frame_from_brake_command(const BrakeCommandFrame& command);

}  // namespace rvbench::hal::can_frames
