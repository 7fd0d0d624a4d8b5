#include "bench/serve/timed_stream.hpp"

#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>

namespace rvbench::bench {
namespace {

using Steady = std::chrono::steady_clock;

constexpr double farewell_s = 1;
constexpr std::size_t longest_farewell = 4 * 1024 * 1024;

Steady::time_point in_seconds(double seconds) {
  return Steady::now() +
         std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(seconds));
}

bool is_ready(int socket, short what, Steady::time_point until) {
  const auto left =
      std::chrono::duration_cast<std::chrono::milliseconds>(until - Steady::now()).count();
  pollfd wanted{socket, what, 0};
  return left > 0 && ::poll(&wanted, 1, static_cast<int>(left)) > 0;
}

template <typename Ask>
void tell(int socket, Ask ask, std::string& ip, int& port) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (ask(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0) return;
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> service{};
  if (::getnameinfo(reinterpret_cast<const sockaddr*>(&address), size, host.data(), host.size(),
                    service.data(), service.size(), NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return;
  }
  ip = host.data();
  port = std::atoi(service.data());
}

}  // namespace

TimedStream::TimedStream(int socket, const HttpLimits& limits)
    : socket_(socket),
      write_s_(limits.write_s),
      left_(limits.head_bytes + limits.body_bytes),
      until_(in_seconds(limits.request_s)) {}

bool TimedStream::is_readable() const { return is_ready(socket_, POLLIN, until_); }

bool TimedStream::is_writable() const { return is_ready(socket_, POLLOUT, in_seconds(write_s_)); }

ssize_t TimedStream::read(char* to, size_t size) {
  if (at_ == end_ && !fill()) return -1;
  const std::size_t count = std::min(size, end_ - at_);
  std::copy_n(buffer_.data() + at_, count, to);
  at_ += count;
  return static_cast<ssize_t>(count);
}

ssize_t TimedStream::write(const char* from, size_t size) {
  const Steady::time_point until = in_seconds(write_s_);
  for (std::size_t sent = 0; sent < size;) {
    const ssize_t more = ::send(socket_, from + sent, size - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (more > 0) sent += static_cast<std::size_t>(more);
    if (more > 0 || (more < 0 && errno == EINTR)) continue;
    if (errno != EAGAIN || !is_ready(socket_, POLLOUT, until)) return -1;
  }
  return static_cast<ssize_t>(size);
}

void TimedStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  tell(socket_, &::getpeername, ip, port);
}

void TimedStream::get_local_ip_and_port(std::string& ip, int& port) const {
  tell(socket_, &::getsockname, ip, port);
}

bool TimedStream::fill() {
  if (left_ == 0 || !is_readable()) return false;
  const ssize_t got = ::recv(socket_, buffer_.data(), std::min(buffer_.size(), left_), 0);
  if (got <= 0) return false;
  at_ = 0;
  end_ = static_cast<std::size_t>(got);
  left_ -= end_;
  return true;
}

void close_gently(int socket) {
  ::shutdown(socket, SHUT_WR);
  const Steady::time_point until = in_seconds(farewell_s);
  std::array<char, 4096> unread{};
  std::size_t bytes = 0;
  while (bytes < longest_farewell && is_ready(socket, POLLIN, until)) {
    const ssize_t got = ::recv(socket, unread.data(), unread.size(), MSG_DONTWAIT);
    if (got <= 0) break;
    bytes += static_cast<std::size_t>(got);
  }
  ::close(socket);
}

}  // namespace rvbench::bench
