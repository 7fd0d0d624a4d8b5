#include "tests/latency/wire_tap.hpp"

#include <poll.h>

#include <array>
#include <utility>
#include <vector>

namespace rvbench::test {

WireTap::WireTap(std::uint16_t server_port, std::function<double()> now_s)
    : server_port_(server_port), now_s_(std::move(now_s)) {
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

WireTap::~WireTap() {
  thread_.request_stop();
  thread_.join();
}

void WireTap::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::vector<pollfd> watched;
    // While the cable is out, bytes and connections pile up at its end, unseen.
    if (!is_pulled_) {
      watched.push_back({listener_.number(), POLLIN, 0});
      for (const Pair& pair : pairs_) {
        watched.push_back({pair.client.number(), POLLIN, 0});
        watched.push_back({pair.server.number(), POLLIN, 0});
      }
    }
    if (::poll(watched.data(), watched.size(), 5) <= 0 || is_pulled_) continue;
    std::vector<Pair> alive;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      Pair& pair = pairs_[i];
      bool lives = true;
      if (watched[1 + 2 * i].revents != 0) lives = forward(pair.client, pair.server, true);
      if (lives && watched[2 + 2 * i].revents != 0) {
        lives = forward(pair.server, pair.client, false);
      }
      if (lives) alive.push_back(std::move(pair));
    }
    pairs_ = std::move(alive);
    if (watched[0].revents != 0) accept_client();
  }
}

// Who cannot be joined to the server is hung up on.
void WireTap::accept_client() {
  Socket client = accepted(listener_);
  Socket server = connected_to(server_port_);
  if (!client || !server) return;
  pairs_.push_back({std::move(client), std::move(server)});
}

bool WireTap::forward(const Socket& from, const Socket& to, bool is_request) {
  std::array<char, 512> bytes{};
  const auto count = ::recv(from.number(), bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (count <= 0) return false;
  if (is_request) look_at({bytes.data(), static_cast<std::size_t>(count)});
  return ::send(to.number(), bytes.data(), static_cast<std::size_t>(count), MSG_NOSIGNAL) == count;
}

// MBAP header of 7 bytes, function 16, address 0x0100, 2 registers, 4 bytes: 0, 0.
void WireTap::look_at(const std::string& request) {
  static const std::string stop("\x10\x01\x00\x00\x02\x04\x00\x00\x00\x00", 10);
  if (request.find(stop, 7) != 7) return;
  double none = -1;
  stop_seen_s_.compare_exchange_strong(none, now_s_());
}

}  // namespace rvbench::test
