#include "hal/modbus/modbus_inverter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace rvbench::hal {
namespace {

constexpr int largest_block = 125;  // registers in one request, by the specification

// The largest speed that the drive can tell.
double largest_speed_rpm(const DriveRegister& at) {
  if (at.words == 2) return at.scale * (at.is_signed ? 2147483647.0 : 4294967295.0);
  return at.scale * (at.is_signed ? 32767 : 65535);
}

}  // namespace

ModbusInverter::ModbusInverter(ModbusInverterOptions options, Clock& clock)
    : options_(std::move(options)),
      status_blocks_(status_blocks(options_.profile)),
      stop_words_(words_for_stop(options_.profile)),
      clock_(clock),
      link_({.path = options_.path,
             .unit_id = options_.unit_id,
             .timeout_s = options_.response_timeout_s + options_.stall_s,
             .turnaround_s = options_.profile.turnaround_s,
             .writable = options_.profile.writable}) {
  const double max_rpm = options_.limits.max_speed_rpm;
  const auto& speed_rpm = options_.profile.speed_rpm;
  if (!(max_rpm > 0) || (speed_rpm && max_rpm > largest_speed_rpm(*speed_rpm))) {
    throw std::invalid_argument(fmt::format(
        "ModbusInverter: max_speed_rpm is {}, must be above 0{}", max_rpm,
        speed_rpm ? fmt::format(", at most {}", largest_speed_rpm(*speed_rpm)) : std::string()));
  }
  const auto& [pole_pairs, rated_Hz] = options_.motor;
  if (pole_pairs < 1) {
    throw std::invalid_argument(
        fmt::format("ModbusInverter: pole_pairs is {}, at least 1", pole_pairs));
  }
  if (!(rated_Hz > 0)) {
    throw std::invalid_argument(
        fmt::format("ModbusInverter: rated_Hz is {}, must be above 0", rated_Hz));
  }
  // Throws if it cannot be told.
  (void)words_for_speed(options_.profile, max_rpm, options_.motor);
}

Status ModbusInverter::connect() {
  return charged([this]() -> Status {
    was_connected_ = true;
    connected_ = false;
    link_.close();
    Status done = attempt([this] { return write_words("stop", stop_words_); });
    if (done) done = reset_trip();
    connected_ = static_cast<bool>(done);
    return done;
  });
}

Result<DriveWatchdog> ModbusInverter::read_watchdog() {
  DriveWords words;
  const Status status = charged([&]() -> Status {
    if (!connected_) return link_.failure(IoErrc::disconnected, "read watchdog");
    return attempt_twice(
        [&] { return read_words("read watchdog", watchdog_blocks(options_.profile), words); });
  });
  if (!status) return status.error();
  return drive_watchdog(options_.profile, words);
}

Status ModbusInverter::set_speed(double speed_rpm) {
  const double max_rpm = options_.limits.max_speed_rpm;
  if (!(std::abs(speed_rpm) <= max_rpm)) {
    throw std::invalid_argument(
        fmt::format("ModbusInverter::set_speed: {} rpm is not within ±{} rpm", speed_rpm, max_rpm));
  }
  return charged([&]() -> Status {
    if (!connected_) return link_.failure(IoErrc::disconnected, "set speed");
    return attempt([&] { return command_speed(speed_rpm); });
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
    (void)attempt_twice([this] { return write_words("stop", stop_words_); });
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
    Status identified = identify();
    if (identified) identified = link_.confirm_in_step();
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

// A family without constants of its own is known by having all the registers of its state.
Status ModbusInverter::identify() {
  const DriveProfile& profile = options_.profile;
  std::vector<DriveBlock> blocks = identity_blocks(profile);
  if (blocks.empty()) blocks = status_blocks_;
  DriveWords words;
  const Status status = read_words("identify", blocks, words);
  if (!status) return status;
  const auto stranger = [&](const std::string& why) {
    return link_.failure(IoErrc::bad_reply, "identify: " + why);
  };
  if (!std::ranges::all_of(profile.identity, [&](const DrivePattern& constant) {
        return constant.holds(words.at(constant.address));
      })) {
    return stranger("not a drive of the profile " + profile.name);
  }
  if (!profile.pole_pairs) return Done{};
  const int pole_pairs = static_cast<int>(value_of(*profile.pole_pairs, words));
  if (pole_pairs == options_.motor.pole_pairs) return Done{};
  return stranger(
      fmt::format("{} pole pairs, configured are {}", pole_pairs, options_.motor.pole_pairs));
}

Status ModbusInverter::read_words(const char* operation, const std::vector<DriveBlock>& blocks,
                                  DriveWords& words) {
  std::array<std::uint16_t, largest_block> block_words{};
  for (const DriveBlock& block : blocks) {
    const auto count = static_cast<std::size_t>(block.count);
    const Status done = link_.read(operation, block.address, {block_words.data(), count});
    if (!done) return done;
    for (std::size_t i = 0; i < count; ++i) {
      words[static_cast<std::uint16_t>(block.address + i)] = block_words[i];
    }
  }
  return Done{};
}

Status ModbusInverter::read_status(DriveStatus& status) {
  DriveWords words;
  const Status done = read_words("read status", status_blocks_, words);
  if (!done) return done;
  const auto told = drive_status(options_.profile, words, options_.motor);
  if (!told) {
    link_.close();
    return link_.failure(IoErrc::bad_reply, "read status: bits that the drive never sets");
  }
  status = *told;
  state_ = state_of(options_.profile, words);
  return Done{};
}

Status ModbusInverter::write_words(const char* operation, const std::vector<DriveWrite>& words) {
  const bool is_block = options_.profile.writes_blocks && words.size() == 2 &&
                        std::abs(words[0].address - words[1].address) == 1;
  if (is_block) {
    const bool in_order = words[0].address < words[1].address;
    const DriveWrite& low = words[in_order ? 0 : 1];
    const std::array block{low.word, words[in_order ? 1 : 0].word};
    return link_.write(operation, low.address, block);
  }
  for (const DriveWrite& write : words) {
    const Status done = link_.write_one(operation, write.address, write.word);
    if (!done) return done;
  }
  return Done{};
}

// The state is the one last read: a word that was sent counts only once the drive shows it.
Status ModbusInverter::command_speed(double speed_rpm) {
  const DriveProfile& profile = options_.profile;
  const std::vector<DriveWrite> words = words_for_speed(profile, speed_rpm, options_.motor);
  const bool is_start = words != stop_words_;
  if (is_start && (state_ == DriveState::fault || state_ == DriveState::fault_reaction)) {
    return link_.failure(IoErrc::refused, "set speed: the drive has tripped");
  }
  const auto step = std::ranges::find(profile.steps, state_, &DriveProfile::Step::from);
  if (!is_start || profile.steps.empty() || state_ == DriveState::running) {
    return write_words("set speed", words);
  }
  const double now_s = clock_.now_s();
  if (now_s < next_step_s_) return Done{};
  if (step == profile.steps.end()) return write_words("set speed", words);
  next_step_s_ = now_s + step->wait_s;
  return write_words("set speed", {{profile.control, step->word}, {profile.reference.address, 0}});
}

Status ModbusInverter::reset_trip() {
  DriveStatus status;
  Status done = read_status(status);
  if (done && status.tripped) {
    for (const DriveWrite& write : options_.profile.reset) {
      if (done) done = link_.write_one("reset", write.address, write.word);
    }
    if (done) done = write_words("stop", stop_words_);
    if (done) done = read_status(status);
  }
  if (!done) return done;
  if (status.tripped) {
    return link_.failure(IoErrc::refused,
                         fmt::format("reset: still tripped, fault code {}", status.fault_code));
  }
  if (!status.remote) {
    return link_.failure(IoErrc::refused, "connect: the drive obeys its panel, not the wire");
  }
  return Done{};
}

}  // namespace rvbench::hal
