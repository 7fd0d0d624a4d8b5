#include "sim/loopback_listener.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace rvbench::sim {
namespace {

constexpr std::chrono::milliseconds rest{100};
constexpr int most_waiting = 8;

}  // namespace

LoopbackListener::LoopbackListener(std::uint16_t port)
    : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  const int yes = 1;
  (void)::setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool listens =
      ::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
      ::listen(socket_, most_waiting) == 0;
  if (listens) return;
  const std::string why = std::strerror(errno);
  if (socket_ >= 0) ::close(socket_);
  throw std::runtime_error("cannot listen on 127.0.0.1:" + std::to_string(port) + ": " + why);
}

LoopbackListener::~LoopbackListener() { ::close(socket_); }

std::uint16_t LoopbackListener::port() const {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  if (::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
  return ntohs(address.sin_port);
}

int LoopbackListener::watched() const { return Time::now() < rests_until_ ? -1 : socket_; }

int LoopbackListener::patience_ms() const {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(rests_until_ - Time::now());
  return left.count() > 0 ? int(left.count()) : -1;
}

int LoopbackListener::accept() {
  const int client = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
  if (client < 0) {
    const bool has_left = errno == EAGAIN || errno == ECONNABORTED || errno == EINTR;
    if (!has_left) rests_until_ = Time::now() + rest;
    return -1;
  }
  // Each reply is whole when it is sent: nothing is gained by waiting for more.
  const int yes = 1;
  (void)::setsockopt(client, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  return client;
}

}  // namespace rvbench::sim
