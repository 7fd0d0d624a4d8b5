#include "hal/service_watchdog.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <systemd/sd-daemon.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace rvbench::hal {
namespace {

// "/run/systemd/notify", or "@name" in no folder; empty if it is no such name.
std::string address_of(std::string_view name) {
  sockaddr_un address{};
  const bool is_name = name.size() > 1 && (name[0] == '/' || name[0] == '@');
  if (!is_name || name.size() > sizeof(address.sun_path)) return "";
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, name.data(), name.size());
  if (name[0] == '@') address.sun_path[0] = '\0';
  return {reinterpret_cast<const char*>(&address), offsetof(sockaddr_un, sun_path) + name.size()};
}

}  // namespace

ServiceWatchdog::ServiceWatchdog() {
  std::uint64_t allowed_us = 0;
  const char* const name = std::getenv("NOTIFY_SOCKET");
  if (name == nullptr || ::sd_watchdog_enabled(0, &allowed_us) <= 0) return;
  address_ = address_of(name);
  if (address_.empty()) return;
  socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  period_s_ = 1e-6 * double(allowed_us) / 4;
}

ServiceWatchdog::~ServiceWatchdog() {
  if (socket_ >= 0) ::close(socket_);
}

void ServiceWatchdog::feed(double now_s) noexcept {
  if (!is_on() || now_s < due_s_) return;
  constexpr std::string_view alive = "WATCHDOG=1";
  sockaddr_un address{};
  std::memcpy(&address, address_.data(), address_.size());
  const auto told = ::sendto(socket_, alive.data(), alive.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                             reinterpret_cast<const sockaddr*>(&address),
                             static_cast<socklen_t>(address_.size()));
  if (told >= 0) due_s_ = now_s + period_s_;
}

}  // namespace rvbench::hal
