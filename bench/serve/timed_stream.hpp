#pragma once

#include <httplib.h>

#include <array>
#include <chrono>
#include <string>

#include "bench/serve/http.hpp"

namespace rvbench::bench {

/// A connection whose request must be there in time, and whose client must take what is sent.
class TimedStream final : public httplib::Stream {
 public:
  TimedStream(int socket, const HttpLimits& limits);

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* to, size_t size) override;
  ssize_t write(const char* from, size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

 private:
  bool fill();

  const int socket_;
  const double write_s_;
  std::size_t left_;  // bytes that may still be read
  const std::chrono::steady_clock::time_point until_;
  std::array<char, 4096> buffer_{};
  std::size_t at_ = 0, end_ = 0;
};

/// Closes it once the client has what was sent: a socket closed with bytes unread resets the
/// connection, and the client may lose the answer.
void close_gently(int socket);

}  // namespace rvbench::bench
