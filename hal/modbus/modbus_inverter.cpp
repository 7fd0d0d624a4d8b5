#include "hal/modbus/modbus_inverter.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace rvbench::hal {

namespace registers = inverter_registers;

ModbusInverter::ModbusInverter(ModbusInverterOptions options, Clock& clock)
    : options_(std::move(options)),
      clock_(clock),
      link_(options_.host, options_.port, options_.unit_id,
            options_.response_timeout_s + options_.stall_s) {
  const double max_rpm = options_.limits.max_speed_rpm;
  if (!(max_rpm > 0 && max_rpm <= registers::max_speed_rpm)) {
    throw std::invalid_argument(
        fmt::format("ModbusInverter: max_speed_rpm is {}, must be above 0, at most {}", max_rpm,
                    registers::max_speed_rpm));
  }
  if (options_.pole_pairs < 1) {
    throw std::invalid_argument(
        fmt::format("ModbusInverter: pole_pairs is {}, at least 1", options_.pole_pairs));
  }
  (void)registers::words_from_speed(max_rpm, options_.pole_pairs);  // throws if it cannot be told
}

Status ModbusInverter::connect() {
  return charged([this]() -> Status {
    was_connected_ = true;
    connected_ = false;
    link_.close();
    const Status ready = attempt([this] { return write_command("stop", registers::stop_words); });
    if (!ready) return ready;
    const Status reset = reset_trip();
    connected_ = static_cast<bool>(reset);
    return reset;
  });
}

Result<DriveWatchdog> ModbusInverter::read_watchdog() {
  registers::Settings settings;
  const Status status = charged([&]() -> Status {
    if (!connected_) return link_.failure(IoErrc::disconnected, "read watchdog");
    return attempt_twice([&] { return identify(settings); });
  });
  if (!status) return status.error();
  return settings.watchdog;
}

Status ModbusInverter::set_speed(double speed_rpm) {
  const double max_rpm = options_.limits.max_speed_rpm;
  if (!(std::abs(speed_rpm) <= max_rpm)) {
    throw std::invalid_argument(
        fmt::format("ModbusInverter::set_speed: {} rpm is not within ±{} rpm", speed_rpm, max_rpm));
  }
  return charged([&]() -> Status {
    if (!connected_) return link_.failure(IoErrc::disconnected, "set speed");
    const auto words = registers::words_from_speed(speed_rpm, options_.pole_pairs);
    return attempt([&] { return write_command("set speed", words); });
  });
}

Result<DriveStatus> ModbusInverter::read() {
  DriveStatus drive_status;
  const Status status = charged([&]() -> Status {
    if (!connected_) return link_.failure(IoErrc::disconnected, "read status");
    return attempt_twice([&] { return read_status(drive_status); });
  });
  if (!status) return status.error();
  return drive_status;
}

void ModbusInverter::stop() noexcept {
  try {
    stop_waits_ = true;
    const std::lock_guard lock(mutex_);
    stop_waits_ = false;
    if (!was_connected_) return;
    (void)attempt_twice([this] { return write_command("stop", registers::stop_words); });
  } catch (...) {
    // Out of memory or no mutex: the drive's own watchdog does the rest.
  }
}

// Runs one call of the role under the lock, then lets the clock catch up with the time-outs it
// met: a real clock has passed them already.
Status ModbusInverter::charged(const std::function<Status()>& call) {
  const double start_s = clock_.now_s();
  int timeouts = 0;
  const Status status = [&] {
    const std::lock_guard lock(mutex_);
    const int before = link_.timeouts();
    Status result = call();
    timeouts = link_.timeouts() - before;
    return result;
  }();
  if (timeouts > 0) clock_.wait_until(start_s + timeouts * options_.response_timeout_s);
  return status;
}

// One request, over a link that was identified since it was opened.
Status ModbusInverter::attempt(const std::function<Status()>& request) {
  if (!link_.is_open()) {
    const Status opened = link_.open();
    if (!opened) return opened;
    registers::Settings settings;
    const Status identified = identify(settings);
    if (!identified) {
      link_.close();  // an exception reply leaves it open: the next request would go to a stranger
      return identified;
    }
  }
  return request();
}

// For requests that do no harm when the drive gets them twice. A link that was found dead is
// tried only once: the caller's deadline is short.
Status ModbusInverter::attempt_twice(const std::function<Status()>& request) {
  const bool was_open = link_.is_open();
  const Status status = attempt(request);
  if (status || !was_open || stop_waits_) return status;
  ++retries_;
  return attempt(request);
}

Status ModbusInverter::identify(registers::Settings& settings) {
  registers::SettingsWords words{};
  const Status status = link_.read("identify", registers::settings.address, words);
  if (!status) return status;
  const auto parsed = registers::settings_from_words(words);
  if (parsed && parsed->pole_pairs == options_.pole_pairs) {
    settings = *parsed;
    return Done{};
  }
  link_.close();
  if (!parsed) return link_.failure(IoErrc::bad_reply, "identify: not an rvbench generic inverter");
  return link_.failure(IoErrc::bad_reply, fmt::format("identify: {} pole pairs, configured are {}",
                                                      parsed->pole_pairs, options_.pole_pairs));
}

Status ModbusInverter::read_status(DriveStatus& status) {
  registers::StatusWords words{};
  const Status done = link_.read("read status", registers::status.address, words);
  if (!done) return done;
  const auto parsed = registers::status_from_words(words);
  if (!parsed) {
    link_.close();
    return link_.failure(IoErrc::bad_reply, "read status: bits that the drive never sets");
  }
  status = *parsed;
  return Done{};
}

Status ModbusInverter::write_command(const char* operation, const registers::CommandWords& words) {
  return link_.write(operation, registers::command.address, words);
}

Status ModbusInverter::reset_trip() {
  DriveStatus status;
  Status done = read_status(status);
  if (!done || !status.tripped) return done;
  done = write_command("reset", registers::reset_words);
  if (done) done = write_command("stop", registers::stop_words);
  if (done) done = read_status(status);
  if (!done || !status.tripped) return done;
  return link_.failure(IoErrc::refused,
                       fmt::format("reset: still tripped, fault code {}", status.fault_code));
}

}  // namespace rvbench::hal
