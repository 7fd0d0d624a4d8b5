#include <fcntl.h>
#include <linux/sockios.h>
#include <linux/tty.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <string>
#include <thread>

#include "hal/can/socketcan_transport.hpp"
#include "tests/kernel/can_interface.hpp"

using namespace rvbench;
using test::next;
using test::numbered;
using test::shell;

namespace {

// A LAWICEL adapter that says what it is told to: the kernel's slcan driver makes frames, error
// frames and controller states of it. Appears as slcan0.
class SlcanAdapter {
 public:
  SlcanAdapter() : adapter_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    REQUIRE(adapter_ >= 0);
    REQUIRE(::grantpt(adapter_) == 0);
    REQUIRE(::unlockpt(adapter_) == 0);
    line_ = ::open(::ptsname(adapter_), O_RDWR | O_NOCTTY);
    REQUIRE(line_ >= 0);
    termios raw{};
    ::cfmakeraw(&raw);
    REQUIRE(::tcsetattr(line_, TCSANOW, &raw) == 0);
    const int discipline = N_SLCAN;
    REQUIRE(::ioctl(line_, TIOCSETD, &discipline) == 0);
    std::array<char, 64> name{};  // at least IFNAMSIZ
    REQUIRE(::ioctl(line_, SIOCGIFNAME, name.data()) == 0);
    // The driver goes on writing once somebody has read what it wrote.
    listener_ = std::jthread([this](const std::stop_token& stop) {
      pollfd written{adapter_, POLLIN, 0};
      std::array<char, 256> heard{};
      while (!stop.stop_requested()) {
        if (::poll(&written, 1, 10) > 0) (void)!::read(adapter_, heard.data(), heard.size());
      }
    });
    shell("ip link set " + std::string(name.data()) + " name slcan0");
    shell("ip link set slcan0 type can bitrate 500000 && ip link set slcan0 up");
  }
  ~SlcanAdapter() {
    listener_.request_stop();
    listener_.join();
    ::close(line_);
    ::close(adapter_);
  }
  SlcanAdapter(const SlcanAdapter&) = delete;
  SlcanAdapter& operator=(const SlcanAdapter&) = delete;

  void says(const std::string& line) {
    REQUIRE(::write(adapter_, line.data(), line.size()) == static_cast<ssize_t>(line.size()));
  }

 private:
  int adapter_ = -1;
  int line_ = -1;
  std::jthread listener_;
};

}  // namespace

SCENARIO("a controller that goes bus-off is lost, and does not come back by itself") {
  SlcanAdapter adapter;
  hal::SteadyClock clock;
  hal::SocketcanTransport bench("slcan0", {0x123}, clock);
  REQUIRE(bench.open());
  adapter.says("t1232AABB\r");
  const auto frame = next(bench);
  REQUIRE(frame);
  CHECK(frame.value().length == 2);
  CHECK(frame.value().data[1] == 0xBB);
  WHEN("it has met some errors") {
    adapter.says("sw100096\r");  // error-warning
    adapter.says("sp130000\r");  // error-passive
    adapter.says("t1231CC\r");
    THEN("frames still come in") { CHECK(next(bench).value().data[0] == 0xCC); }
  }
  WHEN("it goes bus-off") {
    adapter.says("sb000256\r");
    const auto lost = next(bench);
    REQUIRE_FALSE(lost);
    CHECK(lost.error().code == IoErrc::disconnected);
    CHECK_THAT(lost.error().where, Catch::Contains("bus-off"));
    THEN("what comes later is not taken, and nothing is sent") {
      adapter.says("t1231DD\r");
      CHECK(bench.receive().error().code == IoErrc::disconnected);
      CHECK(bench.send(numbered(0x201, 1)).error().code == IoErrc::disconnected);
    }
  }
}
