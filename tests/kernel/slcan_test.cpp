#include <fcntl.h>
#include <linux/sockios.h>
#include <linux/tty.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <thread>

#include "hal/can/in_process_transport.hpp"
#include "hal/can/slcan_transport.hpp"
#include "hal/can/socketcan_counters.hpp"
#include "hal/can/socketcan_transport.hpp"
#include "sim/slcan_adapter.hpp"
#include "tests/kernel/can_interface.hpp"
#include "tests/support/program.hpp"

using namespace rvbench;
using test::next;
using test::numbered;
using test::shell;

namespace {

// Linux' own LAWICEL driver in front of the simulated adapter: it makes frames, error frames and
// controller states of what the adapter says. Appears as slcan0. The nodes are `bus.nodes`.
class SlcanInterface {
 public:
  SlcanInterface() : line_(::open(adapter.device().c_str(), O_RDWR | O_NOCTTY)) {
    REQUIRE(line_ >= 0);
    const int discipline = N_SLCAN;
    REQUIRE(::ioctl(line_, TIOCSETD, &discipline) == 0);
    std::array<char, 64> name{};  // at least IFNAMSIZ
    REQUIRE(::ioctl(line_, SIOCGIFNAME, name.data()) == 0);
    shell("ip link set " + std::string(name.data()) + " name slcan0");
    shell("ip link set slcan0 type can bitrate 500000 && ip link set slcan0 up");
  }
  ~SlcanInterface() { ::close(line_); }
  SlcanInterface(const SlcanInterface&) = delete;
  SlcanInterface& operator=(const SlcanInterface&) = delete;

  hal::InProcessBus bus = hal::make_in_process_bus([] { return 0.0; });
  sim::SlcanAdapter adapter{*bus.bench};

 private:
  int line_;
};

std::set<std::string> terminals() {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator("/dev/pts")) {
    names.insert(entry.path());
  }
  return names;
}

// The adapter of can-utils, in front of vcan0.
class Slcanpty {
 public:
  // It ends as soon as there is something to read on its standard input: never, on this one.
  Slcanpty()
      : program_(folder_.path(),
                 {"/bin/sh", "-c", "mkfifo never && exec slcanpty /dev/ptmx vcan0 <>never"}) {
    REQUIRE(test::wait_until([this] {
      for (const std::string& name : terminals()) {
        if (!before_.contains(name)) device_ = name;
      }
      return !device_.empty();
    }));
  }

  const std::string& device() const { return device_; }

 private:
  const std::set<std::string> before_ = terminals();
  test::ScratchFolder folder_;
  test::Program program_;
  std::string device_;
};

std::uint64_t counted(const hal::BusCounters& counters, const std::string& name) {
  INFO(name);
  REQUIRE(counters.counts.contains(name));
  return counters.counts.at(name);
}

}  // namespace

TEST_CASE("Linux' driver of serial adapters and our adapter understand each other") {
  SlcanInterface slcan;
  hal::SteadyClock clock;
  hal::SocketcanTransport bench("slcan0", {0x123}, clock);
  REQUIRE(bench.open());
  CHECK(slcan.adapter.bitrate_code() == 6);
  CHECK(slcan.adapter.is_channel_open());
  for (std::uint8_t i = 0; i < 100; ++i) {
    REQUIRE(slcan.bus.nodes->send({.id = 0x123, .length = 8, .data = {i, 1, 2, 3, 4, 5, 6, 0xEF}}));
    const auto heard = next(bench);
    REQUIRE(heard);
    CHECK(heard.value().data == std::array<std::uint8_t, 8>{i, 1, 2, 3, 4, 5, 6, 0xEF});
    REQUIRE(bench.send(numbered(0x201, i)));
    const auto command = next(*slcan.bus.nodes);
    REQUIRE(command);
    CHECK(command.value().id == 0x201);
    CHECK(command.value().length == 1);
    CHECK(command.value().data[0] == i);
  }
  shell("ip link set slcan0 down");
  CHECK_FALSE(slcan.adapter.is_channel_open());
}

TEST_CASE("the adapter of can-utils and our transport understand each other") {
  Slcanpty adapter;
  hal::SteadyClock clock;
  hal::SlcanTransport bench({.device = adapter.device(), .ids = {0x281}}, clock);
  hal::SocketcanTransport node("vcan0", {0x201}, clock);
  REQUIRE(node.open());
  REQUIRE(test::wait_until([&] { return bool(bench.open()); }));  // its terminal is locked at first
  for (std::uint8_t i = 0; i < 100; ++i) {
    REQUIRE(bench.send({.id = 0x201, .length = 8, .data = {i, 0xAB, 0, 0, 0, 0, 0, 0xFF}}));
    CHECK(next(node).value().data == std::array<std::uint8_t, 8>{i, 0xAB, 0, 0, 0, 0, 0, 0xFF});
    REQUIRE(node.send(numbered(0x280, 0xEE)));
    REQUIRE(node.send(numbered(0x281, i)));
    const auto heard = next(bench);
    REQUIRE(heard);
    CHECK(heard.value().id == 0x281);
    CHECK(heard.value().data[0] == i);
  }
  const auto counters = bench.monitor()->read();
  REQUIRE(counters);
  for (const auto& [name, count] : counters.value().counts) {
    INFO(name);
    CHECK(count == 0);
  }
}

SCENARIO("a controller that goes bus-off is lost, and does not come back by itself") {
  SlcanInterface slcan;
  hal::SteadyClock clock;
  hal::SocketcanTransport bench("slcan0", {0x123}, clock);
  hal::SocketcanCounters counters("slcan0");
  REQUIRE(bench.open());
  const auto before = counters.read();
  REQUIRE(before);
  WHEN("it has met some errors") {
    slcan.adapter.say("sw100096\r");  // error-warning
    slcan.adapter.say("sp130000\r");  // error-passive
    slcan.adapter.say("e1c\re1o\r");  // a false checksum, an overrun
    slcan.adapter.say("t1231CC\r");
    THEN("frames still come in, and the interface has counted each error") {
      // Lost frames are told before the next frame.
      CHECK(next(bench).error().code == IoErrc::overrun);
      CHECK(next(bench).value().data[0] == 0xCC);
      const auto after = counters.read();
      REQUIRE(after);
      for (const char* name : {"error_warning", "error_passive", "rx_over_errors"}) {
        CHECK(counted(after.value(), name) == counted(before.value(), name) + 1);
      }
      CHECK(counted(after.value(), "rx_errors") == counted(before.value(), "rx_errors") + 2);
      CHECK(counted(after.value(), "bus_off") == counted(before.value(), "bus_off"));
    }
  }
  WHEN("it goes bus-off") {
    slcan.adapter.say("sb000256\r");
    const auto lost = next(bench);
    REQUIRE_FALSE(lost);
    CHECK(lost.error().code == IoErrc::disconnected);
    CHECK_THAT(lost.error().where, Catch::Contains("bus-off"));
    THEN("what comes later is not taken, nothing is sent, and it is counted") {
      REQUIRE(slcan.bus.nodes->send(numbered(0x123, 0xDD)));
      CHECK(bench.receive().error().code == IoErrc::disconnected);
      CHECK(bench.send(numbered(0x201, 1)).error().code == IoErrc::disconnected);
      const auto after = counters.read();
      REQUIRE(after);
      CHECK(counted(after.value(), "bus_off") == counted(before.value(), "bus_off") + 1);
    }
  }
}

TEST_CASE("a full send queue is a lost bus where nobody listens on it") {
  SlcanInterface slcan;
  hal::SteadyClock clock;
  hal::SocketcanTransport bench("slcan0", {0x123}, clock);
  REQUIRE(bench.open());
  slcan.adapter.say("sp000130\rt1231AA\r");  // error-passive: what it sends is not acknowledged
  REQUIRE(next(bench));
  shell("tc qdisc replace dev slcan0 root netem delay 60s limit 1");
  shell("cansend slcan0 123#01");
  const auto sent = bench.send(numbered(0x201, 1));
  REQUIRE_FALSE(sent);
  CHECK(sent.error().code == IoErrc::disconnected);
  CHECK_THAT(sent.error().where, Catch::Contains("nobody on the bus listens"));
  CHECK(bench.receive().error().code == IoErrc::disconnected);
}
