#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/loopback.hpp"

namespace rvbench::test {

/// A cable between a Modbus TCP client and its server that can be pulled, and that notes when a
/// command to stop passed: one that writes run word and setpoint 0 to 0x0100 and 0x0101.
///
/// Threads  forwards in a thread of its own
class WireTap {
 public:
  /// @param now_s  must outlive the tap
  WireTap(std::uint16_t server_port, std::function<double()> now_s);
  ~WireTap();
  WireTap(const WireTap&) = delete;
  WireTap& operator=(const WireTap&) = delete;

  std::uint16_t port() const { return port_of(listener_); }
  double stop_seen_s() const { return stop_seen_s_; }  ///< the first since forget_stop(); -1: none
  void forget_stop() { stop_seen_s_ = -1; }

  /// Nothing passes any more, and nobody is told: as a cable that is out. New connections are not
  /// answered either.
  void pull() { is_pulled_ = true; }

 private:
  struct Pair {
    Socket client, server;
  };

  void run(const std::stop_token& stop);
  void accept_client();
  bool forward(const Socket& from, const Socket& to, bool is_request);
  void look_at(const std::string& request);

  const std::uint16_t server_port_;
  std::function<double()> now_s_;
  Socket listener_ = listening_socket();
  std::vector<Pair> pairs_;  ///< of the thread
  std::atomic<bool> is_pulled_ = false;
  std::atomic<double> stop_seen_s_ = -1;
  std::jthread thread_;
};

}  // namespace rvbench::test
