#pragma once

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <system_error>
#include <utility>

namespace rvbench::test {

/// A socket that is closed with its owner; none if its number is below 0.
class Socket {
 public:
  explicit Socket(int number = -1) : number_(number) {}
  ~Socket() {
    if (number_ >= 0) ::close(number_);
  }
  Socket(Socket&& from) noexcept : number_(std::exchange(from.number_, -1)) {}
  Socket& operator=(Socket&& from) noexcept {
    std::swap(number_, from.number_);
    return *this;
  }

  int number() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_;
};

inline sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

inline std::uint16_t port_of(const Socket& socket) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  if (::getsockname(socket.number(), reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
  return ntohs(address.sin_port);
}

/// A port of 127.0.0.1 for a program that must be told one: until the socket is closed the kernel
/// gives it to nobody who asks for any, and only who sets SO_REUSEADDR can listen at it.
/// @throws std::system_error if there is none
inline Socket reserved_port() {
  Socket socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const int yes = 1;
  (void)::setsockopt(socket.number(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  const sockaddr_in any = loopback(0);
  if (::bind(socket.number(), reinterpret_cast<const sockaddr*>(&any), sizeof any) != 0) {
    throw std::system_error(errno, std::generic_category(), "no port of 127.0.0.1");
  }
  return socket;
}

/// Listens at a port that the kernel chooses. @throws std::system_error if it cannot
inline Socket listening_socket() {
  Socket socket = reserved_port();
  if (::listen(socket.number(), 16) != 0) {
    throw std::system_error(errno, std::generic_category(), "cannot listen on 127.0.0.1");
  }
  return socket;
}

/// What is sent leaves at once, not together with what may come.
inline void send_at_once(const Socket& socket) {
  const int yes = 1;
  (void)::setsockopt(socket.number(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
}

/// The next client, which is waited for; none if there is no descriptor left for it.
inline Socket accepted(const Socket& listener) {
  Socket client(::accept4(listener.number(), nullptr, nullptr, SOCK_CLOEXEC));
  send_at_once(client);
  return client;
}

/// A client of whoever listens there; none if nobody does.
inline Socket connected_to(std::uint16_t port) {
  Socket socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const sockaddr_in address = loopback(port);
  if (::connect(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) !=
      0) {
    return Socket();
  }
  send_at_once(socket);
  return socket;
}

/// The two ends of a line within this process. @throws std::system_error if there is none
inline std::array<Socket, 2> connected_pair() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw std::system_error(errno, std::generic_category(), "no pair of sockets");
  }
  return {Socket(ends[0]), Socket(ends[1])};
}

}  // namespace rvbench::test
