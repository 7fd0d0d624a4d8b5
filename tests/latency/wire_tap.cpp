#include "tests/latency/wire_tap.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace rvbench::test {
namespace {

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

void send_at_once(int socket) {
  const int yes = 1;
  (void)::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
}

int connect_to(std::uint16_t port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const sockaddr_in address = loopback(port);
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    ::close(socket);
    return -1;
  }
  send_at_once(socket);
  return socket;
}

}  // namespace

WireTap::WireTap(std::uint16_t server_port, std::function<double()> now_s)
    : server_port_(server_port),
      now_s_(std::move(now_s)),
      listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address = loopback(0);
  socklen_t size = sizeof address;
  if (::bind(listener_, reinterpret_cast<const sockaddr*>(&address), size) != 0) fail("bind");
  if (::listen(listener_, 4) != 0) fail("listen");
  ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
  port_ = ntohs(address.sin_port);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

WireTap::~WireTap() {
  thread_.request_stop();
  thread_.join();
  ::close(listener_);
}

void WireTap::run(const std::stop_token& stop) {
  std::vector<Pair> pairs;
  while (!stop.stop_requested()) {
    std::vector<pollfd> watched;
    // While the cable is out, bytes and connections pile up at its end, unseen.
    if (!is_pulled_) {
      watched.push_back({listener_, POLLIN, 0});
      for (const Pair& pair : pairs) {
        watched.push_back({pair.client, POLLIN, 0});
        watched.push_back({pair.server, POLLIN, 0});
      }
    }
    if (::poll(watched.data(), watched.size(), 5) <= 0 || is_pulled_) continue;
    std::vector<Pair> alive;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Pair& pair = pairs[i];
      bool lives = true;
      if (watched[1 + 2 * i].revents != 0) lives = forward(pair.client, pair.server, true);
      if (lives && watched[2 + 2 * i].revents != 0)
        lives = forward(pair.server, pair.client, false);
      if (lives) {
        alive.push_back(pair);
      } else {
        ::close(pair.client);
        ::close(pair.server);
      }
    }
    pairs = std::move(alive);
    if (watched[0].revents == 0) continue;
    const int client = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    const int server = connect_to(server_port_);
    send_at_once(client);
    if (client >= 0 && server >= 0) pairs.push_back({client, server});
  }
  for (const Pair& pair : pairs) {
    ::close(pair.client);
    ::close(pair.server);
  }
}

bool WireTap::forward(int from, int to, bool is_request) {
  std::array<char, 512> bytes{};
  const auto count = ::recv(from, bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (count <= 0) return false;
  if (is_request) look_at({bytes.data(), static_cast<std::size_t>(count)});
  return ::send(to, bytes.data(), static_cast<std::size_t>(count), MSG_NOSIGNAL) == count;
}

// MBAP header of 7 bytes, function 16, address 0x0100, 2 registers, 4 bytes: 0, 0.
void WireTap::look_at(const std::string& request) {
  static const std::string stop("\x10\x01\x00\x00\x02\x04\x00\x00\x00\x00", 10);
  if (request.find(stop, 7) != 7) return;
  double none = -1;
  stop_seen_s_.compare_exchange_strong(none, now_s_());
}

}  // namespace rvbench::test
