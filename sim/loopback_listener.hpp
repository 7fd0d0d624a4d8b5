#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace rvbench::sim {

/// Where the servers of a simulated bench take their clients in: a socket that listens on
/// 127.0.0.1, to be polled.
///
/// A process without a descriptor left cannot take in a client that waits, and poll() would tell of
/// it again at once. After such a failure the listener is not to be watched for 0.1 s.
class LoopbackListener {
 public:
  /// @param port  0: the kernel chooses
  /// @throws std::runtime_error if it cannot listen there, with the port
  explicit LoopbackListener(std::uint16_t port);
  ~LoopbackListener();
  LoopbackListener(const LoopbackListener&) = delete;
  LoopbackListener& operator=(const LoopbackListener&) = delete;

  std::uint16_t port() const;

  int watched() const;      ///< for poll(): the socket, or -1 while it is not to be watched
  int patience_ms() const;  ///< for poll(): until it is to be watched again; -1 if it is

  /// The socket of a client that waits, to be closed by the caller; -1 if there is none to be had.
  int accept();

 private:
  using Time = std::chrono::steady_clock;

  int socket_;
  Time::time_point rests_until_;
};

}  // namespace rvbench::sim
