#pragma once

#include <map>
#include <optional>
#include <vector>

#include "hal/drive.hpp"
#include "hal/modbus/drive_profile.hpp"

/// Register words <-> physical values, by a drive's profile. Pure functions.
namespace rvbench::hal {

/// Words by their address on the wire.
using DriveWords = std::map<std::uint16_t, std::uint16_t>;

/// Neighbouring registers that are read by one request.
struct DriveBlock {
  std::uint16_t address = 0;
  int count = 0;
  bool operator==(const DriveBlock&) const = default;
};

/// The requests by which the drive is known: its constants and pole pairs.
std::vector<DriveBlock> identity_blocks(const DriveProfile& profile);
/// The requests by which its state is read.
std::vector<DriveBlock> status_blocks(const DriveProfile& profile);
/// The requests by which its watchdog is read back; none if it cannot be.
std::vector<DriveBlock> watchdog_blocks(const DriveProfile& profile);

/// @throws std::out_of_range if a word of it was not read
double value_of(const DriveRegister& at, const DriveWords& words);

DriveState state_of(const DriveProfile& profile, const DriveWords& words);

/// What turns speeds into a drive's numbers.
struct MotorPlate {
  int pole_pairs = 2;
  double rated_Hz = 50;  ///< what a reference of 100 % stands for, where a drive tells shares of it
};

/// What a drive tells of itself; nothing if it tells what it never tells.
std::optional<DriveStatus> drive_status(const DriveProfile& profile, const DriveWords& words,
                                        const MotorPlate& motor);

/// A watchdog that cannot be read back counts as switched off.
DriveWatchdog drive_watchdog(const DriveProfile& profile, const DriveWords& words);

/// Reference and control word for a motor speed without slip; below the reference's resolution
/// that is a stop. In order of writing.
/// @throws std::invalid_argument if the reference does not fit into its register
std::vector<DriveWrite> words_for_speed(const DriveProfile& profile, double speed_rpm,
                                        const MotorPlate& motor);

/// Control word first.
std::vector<DriveWrite> words_for_stop(const DriveProfile& profile);

}  // namespace rvbench::hal
