#include "hal/modbus/drive_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "hal/types/units.hpp"

namespace rvbench::hal {
namespace {

class Registers {
 public:
  explicit Registers(bool reads_blocks) : reads_blocks_(reads_blocks) {}

  void add(const DriveRegister& at) { numbers_.emplace(at.address, at.words); }
  void add(const std::optional<DriveRegister>& at) {
    if (at) add(*at);
  }
  void add(const DrivePattern& pattern) { numbers_.emplace(pattern.address, 1); }
  void add(const std::optional<DrivePattern>& pattern) {
    if (pattern) add(*pattern);
  }

  // Neighbours in one request, but no gap: drives refuse registers that they do not have.
  std::vector<DriveBlock> blocks() const {
    std::vector<DriveBlock> all;
    for (const auto& [address, words] : numbers_) {
      const int end = address + words;
      if (!all.empty() && end <= all.back().address + all.back().count) continue;
      if (reads_blocks_ && !all.empty() && all.back().address + all.back().count == address) {
        all.back().count += words;
      } else {
        all.push_back({address, words});
      }
    }
    return all;
  }

 private:
  bool reads_blocks_;
  std::set<std::pair<std::uint16_t, int>> numbers_;  // in order of their addresses
};

bool holds(const DrivePattern& pattern, const DriveWords& words) {
  return pattern.holds(words.at(pattern.address));
}

double frequency_Hz(const DriveProfile::Frequency& at, double value, const MotorPlate& motor) {
  switch (at.unit) {
    case DriveProfile::FrequencyUnit::rpm: return units::Hz_from_rpm(value) * motor.pole_pairs;
    case DriveProfile::FrequencyUnit::of_rated: return value * motor.rated_Hz;
    case DriveProfile::FrequencyUnit::Hz: break;
  }
  return value;
}

// What one count of the reference stands for.
double count_Hz(const DriveProfile::Frequency& at, const MotorPlate& motor) {
  return frequency_Hz(at, at.scale, motor);
}

}  // namespace

const char* to_string(DriveState state) noexcept {
  switch (state) {
    case DriveState::not_ready: return "not_ready";
    case DriveState::inhibited: return "inhibited";
    case DriveState::ready: return "ready";
    case DriveState::switched_on: return "switched_on";
    case DriveState::running: return "running";
    case DriveState::quick_stop: return "quick_stop";
    case DriveState::fault_reaction: return "fault_reaction";
    case DriveState::fault: return "fault";
  }
  return "?";
}

std::vector<DriveBlock> identity_blocks(const DriveProfile& profile) {
  Registers registers(profile.reads_blocks);
  for (const DrivePattern& constant : profile.identity) registers.add(constant);
  registers.add(profile.pole_pairs);
  return registers.blocks();
}

std::vector<DriveBlock> status_blocks(const DriveProfile& profile) {
  Registers registers(profile.reads_blocks);
  for (const DriveProfile::State& state : profile.states) registers.add(state.when);
  for (const DrivePattern& pattern : profile.never) registers.add(pattern);
  registers.add(profile.is_remote);
  registers.add(profile.is_reverse);
  registers.add(profile.output_frequency);
  registers.add(profile.speed_rpm);
  registers.add(profile.current_A);
  registers.add(profile.fault_code);
  return registers.blocks();
}

std::vector<DriveBlock> watchdog_blocks(const DriveProfile& profile) {
  Registers registers(profile.reads_blocks);
  if (profile.watchdog) {
    registers.add(profile.watchdog->timeout_s);
    registers.add(profile.watchdog->action);
  }
  return registers.blocks();
}

double value_of(const DriveRegister& at, const DriveWords& words) {
  if (at.words == 1) {
    const std::uint16_t word = words.at(at.address) & at.mask;
    return at.scale * (at.is_signed ? static_cast<std::int16_t>(word) : int{word});
  }
  const std::uint32_t high = words.at(at.address);
  const std::uint32_t number = high << 16U | words.at(static_cast<std::uint16_t>(at.address + 1));
  return at.scale * (at.is_signed ? 1.0 * static_cast<std::int32_t>(number) : 1.0 * number);
}

DriveState state_of(const DriveProfile& profile, const DriveWords& words) {
  for (const DriveProfile::State& state : profile.states) {
    if (holds(state.when, words)) return state.is;
  }
  return DriveState::not_ready;
}

std::optional<DriveStatus> drive_status(const DriveProfile& profile, const DriveWords& words,
                                        const MotorPlate& motor) {
  for (const DrivePattern& pattern : profile.never) {
    if (holds(pattern, words)) return std::nullopt;
  }
  const bool reverse = profile.is_reverse && holds(*profile.is_reverse, words);
  const auto directed = [reverse](const DriveRegister& at, double value) {
    return reverse && !at.is_signed ? -value : value;
  };
  const DriveProfile::Frequency& output = profile.output_frequency;
  const DriveState state = state_of(profile, words);
  DriveStatus status;
  status.output_frequency_Hz =
      directed(output, frequency_Hz(output, value_of(output, words), motor));
  status.speed_rpm = profile.speed_rpm
                         ? directed(*profile.speed_rpm, value_of(*profile.speed_rpm, words))
                         : units::rpm_from_Hz(status.output_frequency_Hz) / motor.pole_pairs;
  if (profile.current_A) status.current_A = value_of(*profile.current_A, words);
  status.running = state == DriveState::running || state == DriveState::quick_stop ||
                   state == DriveState::fault_reaction;
  status.tripped = state == DriveState::fault || state == DriveState::fault_reaction;
  status.remote = !profile.is_remote || holds(*profile.is_remote, words);
  if (profile.fault_code)
    status.fault_code = static_cast<int>(value_of(*profile.fault_code, words));
  return status;
}

DriveWatchdog drive_watchdog(const DriveProfile& profile, const DriveWords& words) {
  if (!profile.watchdog) return {};
  const double timeout_s = value_of(profile.watchdog->timeout_s, words);
  if (timeout_s == 0 || !profile.watchdog->action) return {timeout_s, timeout_s != 0};
  const int action = static_cast<int>(value_of(*profile.watchdog->action, words));
  const std::vector<int>& stopping = profile.watchdog->stopping_actions;
  return {timeout_s, std::find(stopping.begin(), stopping.end(), action) != stopping.end()};
}

std::vector<DriveWrite> words_for_speed(const DriveProfile& profile, double speed_rpm,
                                        const MotorPlate& motor) {
  const DriveProfile::Frequency& reference = profile.reference;
  const double wanted_Hz = units::Hz_from_rpm(speed_rpm) * motor.pole_pairs;
  const double counts = std::round(wanted_Hz / count_Hz(reference, motor));
  if (!(std::abs(counts) <= (reference.is_signed ? 32767 : 65535))) {
    throw std::invalid_argument(fmt::format(
        "words_for_speed: {} Hz does not fit into the reference of {}", wanted_Hz, profile.name));
  }
  if (counts == 0) return words_for_stop(profile);
  const double told = reference.is_signed ? counts : std::abs(counts);
  const auto word = static_cast<std::uint16_t>(static_cast<std::int32_t>(told));
  return {{reference.address, word},
          {profile.control, counts > 0 ? profile.forward : profile.reverse}};
}

std::vector<DriveWrite> words_for_stop(const DriveProfile& profile) {
  return {{profile.control, profile.stop}, {profile.reference.address, 0}};
}

}  // namespace rvbench::hal
