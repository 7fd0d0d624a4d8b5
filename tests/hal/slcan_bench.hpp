#pragma once

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "hal/can/in_process_transport.hpp"
#include "hal/can/slcan_transport.hpp"
#include "hal/steady_clock.hpp"
#include "sim/pseudo_terminal.hpp"
#include "sim/slcan_adapter.hpp"
#include "tests/support/can_frames.hpp"

namespace rvbench::test {

/// An adapter in front of a bus, in real time. The nodes are `bus.nodes`.
struct SlcanBench {
  hal::SteadyClock clock;
  hal::InProcessBus bus = hal::make_in_process_bus([this] { return clock.now_s(); });
  std::unique_ptr<sim::SlcanAdapter> adapter = std::make_unique<sim::SlcanAdapter>(*bus.bench);

  hal::SlcanOptions options(std::vector<std::uint32_t> ids = {0x281}) const {
    return {.device = adapter->device(), .ids = std::move(ids)};
  }
};

/// An adapter that answers each command as it is told to: one of another make, or a broken one.
class OddAdapter {
 public:
  /// @param rest  from an answer until it listens again
  explicit OddAdapter(std::function<std::string(const std::string&)> answer,
                      std::chrono::milliseconds rest = {})
      : answer_(std::move(answer)),
        rest_(rest),
        thread_([this](const std::stop_token& stop) { serve(stop); }) {}

  const std::string& device() const { return terminal_.device(); }

 private:
  void serve(const std::stop_token& stop) {
    std::string command;
    pollfd line{terminal_.master(), POLLIN, 0};
    while (!stop.stop_requested()) {
      char c = 0;
      if (::poll(&line, 1, 1) <= 0 || ::read(line.fd, &c, 1) != 1) continue;
      if (c != '\r') {
        command += c;
        continue;
      }
      const std::string answer = answer_(command);
      (void)!::write(line.fd, answer.data(), answer.size());
      command.clear();
      std::this_thread::sleep_for(rest_);
    }
  }

  std::function<std::string(const std::string&)> answer_;
  std::chrono::milliseconds rest_;
  sim::PseudoTerminal terminal_;
  std::jthread thread_;
};

/// What an adapter in good health answers.
inline std::string sound_answer(const std::string& command) {
  switch (command.empty() ? ' ' : command[0]) {
    case 'V': return "V1013\r";
    case 'F': return "F00\r";
    case 't': return "z\r";
    default: return "\r";
  }
}

inline void must_open(hal::CanTransport& can) {
  const Status opened = can.open();
  INFO((opened ? "opened" : describe(opened.error())));
  REQUIRE(opened);
}

/// Sends as soon as the frame before is acknowledged.
inline Status send_next(hal::CanTransport& can, const hal::CanFrame& frame) {
  Status sent = IoError{IoErrc::timeout, "not tried yet"};
  (void)wait_until([&] {
    sent = can.send(frame);
    return sent || sent.error().code != IoErrc::timeout;
  });
  return sent;
}

/// On a busy computer an answer may take longer than the monitor waits for it.
inline hal::BusCounters counters(hal::BusMonitor& monitor) {
  auto read = monitor.read();
  (void)wait_until([&] {
    if (!read && read.error().code == IoErrc::timeout) read = monitor.read();
    return read || read.error().code != IoErrc::timeout;
  });
  REQUIRE(read);
  return std::move(read).value();
}

inline std::uint64_t counted(hal::BusMonitor& monitor, const std::string& name) {
  const auto counts = counters(monitor).counts;
  const auto found = counts.find(name);
  return found == counts.end() ? 0 : found->second;
}

}  // namespace rvbench::test
