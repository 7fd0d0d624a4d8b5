#include "hal/service_watchdog.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <cstring>
#include <string>

#include "tests/support/scratch_folder.hpp"

using rvbench::hal::ServiceWatchdog;

namespace {

// The service manager's end: a datagram socket whose name the service is told.
class Manager {
 public:
  explicit Manager(const std::string& path) : socket_(::socket(AF_UNIX, SOCK_DGRAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    REQUIRE(path.size() < sizeof(address.sun_path));
    std::strcpy(address.sun_path, path.c_str());
    REQUIRE(::bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof(address)) == 0);
    ::setenv("NOTIFY_SOCKET", path.c_str(), 1);
    ::setenv("WATCHDOG_USEC", "2000000", 1);
    ::setenv("WATCHDOG_PID", std::to_string(::getpid()).c_str(), 1);
  }
  ~Manager() {
    ::close(socket_);
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(name);
  }
  Manager(const Manager&) = delete;
  Manager& operator=(const Manager&) = delete;

  std::string heard() const {
    std::array<char, 256> text{};
    const auto count = ::recv(socket_, text.data(), text.size(), MSG_DONTWAIT);
    return count < 0 ? "" : std::string(text.data(), std::size_t(count));
  }

 private:
  int socket_;
};

}  // namespace

TEST_CASE("systemd's watchdog is fed four times within its time", "[hal]") {
  const rvbench::test::ScratchFolder scratch;
  const Manager manager((scratch / "notify").string());
  ServiceWatchdog watchdog;
  CHECK(watchdog.is_on());
  watchdog.feed(10);
  CHECK(manager.heard() == "WATCHDOG=1");
  watchdog.feed(10.4);
  CHECK(manager.heard().empty());
  watchdog.feed(10.5);
  CHECK(manager.heard() == "WATCHDOG=1");
}

TEST_CASE("without a service manager there is nothing to feed", "[hal]") {
  ::unsetenv("WATCHDOG_USEC");
  ServiceWatchdog watchdog;
  CHECK_FALSE(watchdog.is_on());
  watchdog.feed(1);
}
