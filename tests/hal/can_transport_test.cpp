#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <deque>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "hal/can/can_dispatcher.hpp"
#include "hal/can/in_process_transport.hpp"
#include "hal/can/socketcan_transport.hpp"
#include "tests/hal/can_bench.hpp"
#include "tests/support/can_frames.hpp"

using namespace rvbench;
using test::numbered;

namespace {

// A bus that gives frames and errors as scripted, then nothing.
class ScriptedBus final : public hal::CanTransport {
 public:
  explicit ScriptedBus(std::deque<Result<hal::CanFrame>>& script) : script_(script) {}
  Status open() override { return Done{}; }
  Status send(const hal::CanFrame&) override { return Done{}; }
  Result<hal::CanFrame> receive() override {
    if (script_.empty()) return IoError{IoErrc::timeout, "nothing"};
    Result<hal::CanFrame> next = script_.front();
    script_.pop_front();
    return next;
  }

 private:
  std::deque<Result<hal::CanFrame>>& script_;
};

bool kernel_has_can() {
  const int probe = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, 1);
  if (probe >= 0) ::close(probe);
  return probe >= 0 || errno != EAFNOSUPPORT;
}

}  // namespace

SCENARIO("a bus in this process carries frames both ways, in order", "[hal][can]") {
  double now_s = 3.25;
  auto bus = hal::make_in_process_bus([&] { return now_s; }, 4);
  REQUIRE(bus.bench->open());
  CHECK(bus.bench->receive().error().code == IoErrc::timeout);
  REQUIRE(bus.nodes->send(numbered(1, 10)));
  REQUIRE(bus.nodes->send(numbered(2, 20)));
  REQUIRE(bus.bench->send(numbered(3, 30)));
  now_s = 4;
  const auto first = bus.bench->receive();
  REQUIRE(first);
  CHECK(first.value().id == 1);
  CHECK(first.value().time_s == 3.25);
  CHECK(bus.bench->receive().value().data[0] == 20);
  CHECK(bus.nodes->receive().value().id == 3);
  CHECK_FALSE(bus.nodes->receive());
  WHEN("more frames wait than the queue holds") {
    for (std::uint8_t i = 0; i < 6; ++i) REQUIRE(bus.nodes->send(numbered(1, i)));
    THEN("the oldest are lost") {
      for (std::uint8_t i = 2; i < 6; ++i) CHECK(bus.bench->receive().value().data[0] == i);
      CHECK_FALSE(bus.bench->receive());
    }
  }
  WHEN("one end is gone") {
    bus.bench.reset();
    THEN("the other can still send") { CHECK(bus.nodes->send(numbered(1, 1))); }
  }
}

TEST_CASE("the ends of a bus may live in different threads", "[hal][can]") {
  auto bus = hal::make_in_process_bus([] { return 0.0; });
  std::thread sender([&] {
    for (int i = 0; i < 2000; ++i) (void)bus.nodes->send(numbered(1, static_cast<std::uint8_t>(i)));
  });
  int received = 0;
  while (received < 2000) {
    const auto frame = bus.bench->receive();
    if (!frame) continue;
    REQUIRE(frame.value().data[0] == static_cast<std::uint8_t>(received));
    ++received;
  }
  sender.join();
}

SCENARIO("each device gets its own frames, whoever asks first", "[hal][can]") {
  auto bus = hal::make_in_process_bus([] { return 0.0; });
  auto ports = hal::split_by_id(std::move(bus.bench), {0x181, 0x281});
  REQUIRE(ports.size() == 2);
  REQUIRE(ports[0]->open());
  REQUIRE(ports[1]->open());
  for (std::uint8_t i = 0; i < 3; ++i) {
    REQUIRE(bus.nodes->send(numbered(0x181, i)));
    REQUIRE(bus.nodes->send(numbered(0x7FF, i)));
    REQUIRE(bus.nodes->send(numbered(0x281, static_cast<std::uint8_t>(100 + i))));
  }
  for (std::uint8_t i = 0; i < 3; ++i) CHECK(ports[1]->receive().value().data[0] == 100 + i);
  CHECK(ports[1]->receive().error().code == IoErrc::timeout);
  for (std::uint8_t i = 0; i < 3; ++i) CHECK(ports[0]->receive().value().data[0] == i);
  CHECK(ports[0]->receive().error().code == IoErrc::timeout);
  WHEN("a port sends") {
    REQUIRE(ports[1]->send(numbered(0x201, 5)));
    THEN("it goes to the bus") { CHECK(bus.nodes->receive().value().id == 0x201); }
  }
  WHEN("one port is gone") {
    ports[0].reset();
    THEN("the other goes on") {
      REQUIRE(bus.nodes->send(numbered(0x281, 7)));
      CHECK(ports[1]->receive().value().data[0] == 7);
    }
  }
}

SCENARIO("every device hears of an error of the bus", "[hal][can]") {
  std::deque<Result<hal::CanFrame>> script{numbered(0x181, 1),
                                           IoError{IoErrc::overrun, "frames were dropped"},
                                           numbered(0x181, 2), numbered(0x281, 3)};
  auto ports = hal::split_by_id(std::make_unique<ScriptedBus>(script), {0x181, 0x281});
  REQUIRE(ports[0]->open());
  REQUIRE(ports[1]->open());
  const auto codes = [&](hal::CanTransport& port) {
    std::vector<IoErrc> heard;
    for (int i = 0; i < 4; ++i) {
      if (const auto received = port.receive(); !received) heard.push_back(received.error().code);
    }
    return heard;
  };
  // Two frames for one port, one for the other; then each is told once.
  CHECK(codes(*ports[0]) == std::vector{IoErrc::overrun, IoErrc::timeout});
  CHECK(codes(*ports[1]) == std::vector{IoErrc::overrun, IoErrc::timeout, IoErrc::timeout});
  WHEN("one device opens a lost bus anew") {
    script.emplace_back(IoError{IoErrc::disconnected, "bus-off"});
    CHECK(ports[0]->receive().error().code == IoErrc::disconnected);
    REQUIRE(ports[0]->open());
    THEN("the other does not go on as if nothing had been") {
      CHECK(codes(*ports[1]).front() == IoErrc::disconnected);
      CHECK(ports[0]->receive().error().code == IoErrc::timeout);
    }
  }
}

TEST_CASE("without a CAN bus, SocketCAN says clearly what is missing", "[hal][can]") {
  test::CanBench world;
  hal::SocketcanTransport can("nosuchcan0", {0x181}, world);
  CHECK(can.receive().error().code == IoErrc::disconnected);
  CHECK(can.send({}).error().code == IoErrc::disconnected);
  const auto opened = can.open();
  REQUIRE_FALSE(opened);
  CHECK(opened.error().code == IoErrc::disconnected);
  CHECK_THAT(opened.error().where, Catch::Contains("nosuchcan0"));
  CHECK_THAT(opened.error().where,
             Catch::Contains(kernel_has_can() ? "no such interface" : "no CAN support"));
}

TEST_CASE("an interface name or identifier that cannot be is the caller's bug", "[hal][can]") {
  test::CanBench world;
  CHECK_THROWS_AS(hal::SocketcanTransport("", {}, world), std::invalid_argument);
  CHECK_THROWS_AS(hal::SocketcanTransport("a_name_that_is_too_long", {}, world),
                  std::invalid_argument);
  CHECK_THROWS_AS(hal::SocketcanTransport("can0", {0x800}, world), std::invalid_argument);
}
