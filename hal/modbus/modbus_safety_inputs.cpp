#include "hal/modbus/modbus_safety_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/real_time.hpp"
#include "hal/types/require_positive.hpp"

namespace rvbench::hal {
namespace {

constexpr int most_bits = 2000;  // in one request, by the specification
// A coupler that refuses connections is not asked for one a hundred times a second.
constexpr double pause_after_failure_s = 0.1;

void check(const ModbusSafetyOptions& options) {
  require_positive(options.period_s, "ModbusSafetyInputs", "period_s");
  require_positive(options.deadline_s, "ModbusSafetyInputs", "deadline_s");
  const int apart = std::abs(options.estop.address - options.guard.address);
  if (apart == 0) {
    throw std::invalid_argument("ModbusSafetyInputs: emergency stop and guard on one input");
  }
  if (apart >= most_bits) {
    throw std::invalid_argument(
        fmt::format("ModbusSafetyInputs: inputs {} and {} do not fit into one request of {} bits",
                    options.estop.address, options.guard.address, most_bits));
  }
  const TemperatureRegister& at = options.temperature;
  if (at.scale_degC == 0 || !std::isfinite(at.scale_degC) || !std::isfinite(at.offset_degC)) {
    throw std::invalid_argument(
        fmt::format("ModbusSafetyInputs: a temperature of {} degC per count, {} degC at 0",
                    at.scale_degC, at.offset_degC));
  }
  if (!(at.min_degC < at.max_degC)) {
    throw std::invalid_argument(fmt::format(
        "ModbusSafetyInputs: no temperature is within {} to {} degC", at.min_degC, at.max_degC));
  }
}

double temperature_degC(const TemperatureRegister& at, std::uint16_t word) {
  const double count = at.is_signed ? static_cast<std::int16_t>(word) : word;
  const double temp_degC = at.offset_degC + at.scale_degC * count;
  return temp_degC >= at.min_degC && temp_degC <= at.max_degC ? temp_degC : not_known;
}

}  // namespace

ModbusSafetyInputs::ModbusSafetyInputs(const ModbusSafetyOptions& options, const Clock& clock)
    : options_(options),
      clock_(clock),
      link_({.path = options.path,
             .device = "safety inputs",
             .unit_id = options.unit_id,
             .timeout_s = options.response_timeout_s,
             .writable = {}}) {
  check(options);
}

ModbusSafetyInputs::~ModbusSafetyInputs() = default;

Status ModbusSafetyInputs::connect() {
  poller_.stop();  // an earlier one ends before the link is somebody else's
  link_.close();
  polled_ = {};
  ask_and_note();
  read_ = polled_;
  if (polled_.failure) return *polled_.failure;
  poller_.start([this](const std::stop_token& stop) { poll(stop); });
  return Done{};
}

// Who reads may be more urgent than who polls: while that one has the lock, what was read before
// is as good, and no older than its age says.
Result<SafetyStatus> ModbusSafetyInputs::read() {
  if (const std::unique_lock lock(mutex_, std::try_to_lock); lock) read_ = told_;
  if (const std::string_view thrown = poller_.thrown(); !thrown.empty()) {
    return link_.failure(IoErrc::disconnected, fmt::format("read: nobody asks: {}", thrown));
  }
  if (!read_.status) return link_.failure(IoErrc::disconnected, "read");
  const double age_s = clock_.now_s() - read_.status->time_s;
  if (age_s <= options_.deadline_s) return *read_.status;
  const std::string why = read_.failure ? " (" + describe(*read_.failure) + ")" : "";
  return link_.failure(IoErrc::timeout, fmt::format("read: no answer for {:.2f} s{}", age_s, why));
}

Result<SafetyStatus> ModbusSafetyInputs::ask() {
  if (!link_.is_open()) {
    if (const Status opened = open(); !opened) return opened.error();
  }
  return ask_once();
}

// Where older answers may still be under way, nothing is kept of a first round.
Status ModbusSafetyInputs::open() {
  Status done = link_.open();
  if (!done || !link_.is_in_doubt()) return done;
  if (const auto first = ask_once(); !first) {
    link_.close();  // an exception reply leaves it open: the next answer would not be doubted
    return first.error();
  }
  return link_.confirm_in_step();
}

// One round of questions.
Result<SafetyStatus> ModbusSafetyInputs::ask_once() {
  const double asked_s = clock_.now_s();
  const auto first = std::min(options_.estop.address, options_.guard.address);
  const auto last = std::max(options_.estop.address, options_.guard.address);
  std::vector<std::uint8_t> bits(static_cast<std::size_t>(last - first + 1));
  if (const Status done = link_.read_bits("read contacts", first, bits); !done) {
    return done.error();
  }
  std::array<std::uint16_t, 1> word{};
  const TemperatureRegister& at = options_.temperature;
  const Status done = at.is_holding ? link_.read("read temperature", at.address, word)
                                    : link_.read_inputs("read temperature", at.address, word);
  if (!done) return done.error();
  const auto is_open = [&](const SafetyContact& contact) {
    return (bits[contact.address - first] != 0) != contact.closed;
  };
  return SafetyStatus{.estop_pressed = is_open(options_.estop),
                      .guard_open = is_open(options_.guard),
                      .housing_temp_degC = temperature_degC(at, word[0]),
                      .time_s = asked_s};
}

void ModbusSafetyInputs::ask_and_note() {
  Result<SafetyStatus> answer = ask();
  if (answer) {
    polled_ = {std::move(answer).value(), std::nullopt};
  } else {
    polled_.failure = answer.error();
  }
  const std::lock_guard lock(mutex_);
  told_ = polled_;
}

void ModbusSafetyInputs::poll(const std::stop_token& stop) {
  using Steady = std::chrono::steady_clock;
  (void)make_this_thread_urgent();  // an emergency stop is on its way here
  for (;;) {
    const auto asked = Steady::now();
    ask_and_note();
    const std::chrono::duration<double> pause(polled_.failure ? pause_after_failure_s
                                                              : options_.period_s);
    std::unique_lock lock(mutex_);
    ending_.wait_until(lock, stop, asked + std::chrono::duration_cast<Steady::duration>(pause),
                       [] { return false; });
    if (stop.stop_requested()) return;
  }
}

}  // namespace rvbench::hal
