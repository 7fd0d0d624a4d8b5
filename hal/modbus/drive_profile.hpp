#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rvbench::hal {

/// What state a drive is in, whatever its own words for it are. The names are those of CiA 402;
/// drives that know fewer states never tell the others.
enum class DriveState {
  not_ready,       ///< starting up, or without mains
  inhibited,       ///< will not switch on before it is asked to get ready
  ready,           ///< stopped
  switched_on,     ///< stopped, one step before running
  running,         ///< the output is on, also on its ramp to standstill
  quick_stop,      ///< on its fastest ramp
  fault_reaction,  ///< tripped, and still on its way to standstill
  fault            ///< tripped
};

const char* to_string(DriveState state) noexcept;  ///< "switched_on"

/// Where a number lives in a drive, and what one count of it is.
struct DriveRegister {
  std::uint16_t address = 0;    ///< on the wire, 0-based
  int words = 1;                ///< 2: the higher word at the lower address
  std::uint16_t mask = 0xFFFF;  ///< of the number's bits; of two words all are taken
  bool is_signed = false;       ///< two's complement of all its bits
  double scale = 1;             ///< one count, in the unit that the profile's key names
  bool operator==(const DriveRegister&) const = default;
};

/// Bits of a register that say something when they have a value, or when they have not.
struct DrivePattern {
  std::uint16_t address = 0;
  std::uint16_t mask = 0xFFFF;
  std::uint16_t value = 0;
  bool is_not = false;

  bool holds(std::uint16_t word) const { return ((word & mask) == value) != is_not; }
};

/// One word to one register.
struct DriveWrite {
  std::uint16_t address = 0;
  std::uint16_t word = 0;
  bool operator==(const DriveWrite&) const = default;
};

/// A family of inverters, as a file in hal/modbus/drives/ tells it: registers, scales, bits,
/// states, and what may be written at all. The files say for each value where it was found.
struct DriveProfile {
  std::string name;
  std::string about;          ///< the models that it is for
  bool reads_blocks = true;   ///< false: one number per request
  bool writes_blocks = true;  ///< false: function 6, one register per request
  double turnaround_s = 0;    ///< silence that the drive needs between a reply and a request

  std::vector<DrivePattern> identity;  ///< constants by which the family is known, if it has any
  std::optional<DriveRegister> pole_pairs;  ///< as the drive has them set

  struct State {
    DriveState is = DriveState::not_ready;
    DrivePattern when;
  };
  std::vector<State> states;               ///< the first that holds; none: not_ready
  std::vector<DrivePattern> never;         ///< what the drive never tells
  std::optional<DrivePattern> is_remote;   ///< it obeys the wire, and nobody at its panel
  std::optional<DrivePattern> is_reverse;  ///< where readings are magnitudes

  std::uint16_t control = 0;  ///< address of the control word
  std::uint16_t forward = 0, reverse = 0, stop = 0;
  /// Words that lead from a state toward the one in which `forward` or `reverse` starts the motor.
  struct Step {
    DriveState from = DriveState::inhibited;
    std::uint16_t word = 0;
    double wait_s = 0;  ///< before the next one
  };
  std::vector<Step> steps;
  std::vector<DriveWrite> reset;  ///< in order; clears a fault, on an edge

  enum class FrequencyUnit { Hz, rpm, of_rated };
  /// Speed in one of the ways that drives tell it: frequency, synchronous speed, share of the rated
  /// frequency.
  struct Frequency : DriveRegister {
    FrequencyUnit unit = FrequencyUnit::Hz;
  };
  Frequency reference;
  Frequency output_frequency;
  std::optional<DriveRegister> speed_rpm;  ///< without: from the output frequency, less no slip
  std::optional<DriveRegister> current_A;
  std::optional<DriveRegister> fault_code;

  /// How the drive says what it does when nobody talks to it any more.
  struct Watchdog {
    DriveRegister timeout_s;
    std::optional<DriveRegister> action;  ///< without: it stops whenever the time-out is on
    std::vector<int> stopping_actions;
  };
  std::optional<Watchdog> watchdog;  ///< without: it cannot be read back

  std::vector<std::uint16_t> writable;  ///< all that may ever be written
  std::vector<std::string> unverified;  ///< keys whose values were found in one source only
};

}  // namespace rvbench::hal
