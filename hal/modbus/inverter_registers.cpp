#include "hal/modbus/inverter_registers.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "hal/types/units.hpp"

namespace rvbench::hal::inverter_registers {
namespace {

constexpr std::uint16_t identity = 0x5242;
constexpr std::uint16_t run_forward = 0x0001;
constexpr std::uint16_t run_reverse = 0x0002;
constexpr int ignore_comm_loss = 0;
constexpr int coast_on_comm_loss = 2;
constexpr unsigned output_on = 0x0001;
constexpr unsigned tripped = 0x0002;
constexpr unsigned backwards = 0x0004;

}  // namespace

CommandWords words_from_speed(double speed_rpm, int pole_pairs) {
  const double frequency_Hz = units::Hz_from_rpm(std::abs(speed_rpm)) * pole_pairs;
  const double hundredths = std::round(100 * frequency_Hz);
  if (!(hundredths <= 65535)) {
    throw std::invalid_argument("words_from_speed: " + std::to_string(frequency_Hz) +
                                " Hz is above 655.35 Hz");
  }
  if (hundredths == 0) return stop_words;
  return {speed_rpm > 0 ? run_forward : run_reverse, static_cast<std::uint16_t>(hundredths)};
}

std::optional<Settings> settings_from_words(const SettingsWords& words) {
  const auto [id, pole_pairs, timeout_ds, action] = words;
  if (id != identity || pole_pairs == 0 || action > coast_on_comm_loss) return std::nullopt;
  return Settings{.pole_pairs = pole_pairs,
                  .watchdog = {.timeout_s = timeout_ds / 10.0,
                               .stops_motor = timeout_ds != 0 && action != ignore_comm_loss}};
}

std::optional<DriveStatus> status_from_words(const StatusWords& words) {
  const auto [bits, frequency_cHz, current_cA, speed_drpm, fault] = words;
  if ((bits & ~(output_on | tripped | backwards)) != 0) return std::nullopt;
  const double magnitude_Hz = frequency_cHz / 100.0;
  return DriveStatus{.speed_rpm = static_cast<std::int16_t>(speed_drpm) / 10.0,
                     .output_frequency_Hz = (bits & backwards) != 0 ? -magnitude_Hz : magnitude_Hz,
                     .current_A = current_cA / 100.0,
                     .running = (bits & output_on) != 0,
                     .tripped = (bits & tripped) != 0,
                     .fault_code = fault};
}

}  // namespace rvbench::hal::inverter_registers
