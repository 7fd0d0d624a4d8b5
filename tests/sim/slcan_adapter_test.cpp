#include "sim/slcan_adapter.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <string>

#include "hal/can/in_process_transport.hpp"

using namespace rvbench;

namespace {

// A terminal at which somebody types what the manual says.
class Terminal {
 public:
  explicit Terminal(const std::string& device)
      : file_(::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    REQUIRE(file_ >= 0);
  }
  ~Terminal() { ::close(file_); }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  // The answer's first bytes, as many as are expected; fewer if they do not come.
  std::string ask(const std::string& command, std::size_t expected) {
    REQUIRE(::write(file_, command.data(), command.size()) == static_cast<ssize_t>(command.size()));
    return hear(expected);
  }

  std::string hear(std::size_t expected) {
    std::string heard;
    pollfd line{file_, POLLIN, 0};
    char c = 0;
    while (heard.size() < expected && ::poll(&line, 1, 5000) > 0 && ::read(file_, &c, 1) == 1) {
      heard += c;
    }
    return heard;
  }

 private:
  int file_;
};

}  // namespace

SCENARIO("the simulated adapter answers as LAWICEL's manual has it", "[sim][can]") {
  auto bus = hal::make_in_process_bus([] { return 0.0; });
  sim::SlcanAdapter adapter(*bus.bench);
  Terminal terminal(adapter.device());
  CHECK(terminal.ask("V\r", 6) == "V1013\r");
  CHECK(terminal.ask("N\r", 6) == "NRV01\r");
  CHECK(terminal.ask("O\r", 1) == "\a");  // no bit rate yet
  CHECK(terminal.ask("S9\r", 1) == "\a");
  CHECK(terminal.ask("S6\r", 1) == "\r");
  CHECK(adapter.bitrate_code() == 6);
  CHECK(terminal.ask("F\r", 1) == "\a");
  CHECK(terminal.ask("t1230\r", 1) == "\a");
  CHECK(terminal.ask("C\r", 1) == "\a");
  CHECK(terminal.ask("O\r", 1) == "\r");
  CHECK(terminal.ask("O\r", 1) == "\a");
  CHECK(terminal.ask("S5\r", 1) == "\a");
  THEN("frames pass while the channel is open") {
    CHECK(terminal.ask("t1232AABB\r", 2) == "z\r");
    const auto frame = bus.nodes->receive();
    REQUIRE(frame);
    CHECK(frame.value().id == 0x123);
    CHECK(frame.value().length == 2);
    CHECK(frame.value().data[1] == 0xBB);
    REQUIRE(bus.nodes->send({.id = 0x7FF, .length = 1, .data = {0x0C}}));
    CHECK(terminal.hear(8) == "t7FF10C\r");
    CHECK(terminal.ask("C\r", 1) == "\r");
    REQUIRE(bus.nodes->send({.id = 0x7FF}));
    CHECK(terminal.ask("V\r", 1) == "V");
  }
  THEN("what is no frame is declined, and does not reach the bus") {
    for (const std::string wrong :
         {"t8000", "t1239", "t1239001122334455667788", "t123", "t1231A", "t1231AAB", "tXYZ0", "q",
          "", "t1231GG", "VV", "this is much longer than any command is"}) {
      INFO(wrong);
      CHECK(terminal.ask(wrong + '\r', 1) == "\a");
    }
    CHECK(terminal.ask("T000001231AA\r", 2) == "Z\r");
    CHECK(terminal.ask("r1230\r", 2) == "z\r");
    CHECK(adapter.frames_to_bus() == 0);
    CHECK_FALSE(bus.nodes->receive());
  }
  THEN("flags are told once") {
    CHECK(terminal.ask("F\r", 4) == "F00\r");
    adapter.raise_flags(0x0C);
    CHECK(terminal.ask("F\r", 4) == "F0C\r");
    CHECK(terminal.ask("F\r", 4) == "F00\r");
  }
  THEN("a channel that only listens sends nothing") {
    CHECK(terminal.ask("C\r", 1) == "\r");
    CHECK(terminal.ask("L\r", 1) == "\r");
    CHECK(terminal.ask("t1230\r", 1) == "\a");
    REQUIRE(bus.nodes->send({.id = 1}));
    CHECK(terminal.hear(6) == "t0010\r");
  }
  THEN("frames carry the time, if that is switched on") {
    CHECK(terminal.ask("Z1\r", 1) == "\a");
    CHECK(terminal.ask("C\r", 1) == "\r");
    CHECK(terminal.ask("Z2\r", 1) == "\a");
    CHECK(terminal.ask("Z0\r", 1) == "\r");
    CHECK(terminal.ask("Z1\r", 1) == "\r");
    CHECK(terminal.ask("O\r", 1) == "\r");
    REQUIRE(bus.nodes->send({.id = 1}));
    const std::string line = terminal.hear(10);
    CHECK(line.substr(0, 5) == "t0010");
    CHECK(std::stoi(line.substr(5, 4), nullptr, 16) < 60000);
    CHECK(line.back() == '\r');
  }
}

SCENARIO("the simulated adapter misbehaves when told to", "[sim][can]") {
  auto bus = hal::make_in_process_bus([] { return 0.0; });
  sim::SlcanAdapter adapter(*bus.bench);
  Terminal terminal(adapter.device());
  REQUIRE(terminal.ask("S5\rO\r", 2) == "\r\r");
  WHEN("its controller is off the bus") {
    adapter.inject(sim::SlcanFault::bus_off);
    CHECK(terminal.ask("F\r", 4) == "FA4\r");
    CHECK(terminal.ask("t1230\r", 2) == "z\r");
    CHECK(adapter.frames_to_bus() == 0);
  }
  WHEN("what it says is garbled") {
    adapter.inject(sim::SlcanFault::garbled);
    CHECK(terminal.ask("V\r", 7) == "V10?13\r");
  }
  WHEN("it is silent") {
    adapter.inject(sim::SlcanFault::silent);
    terminal.ask("t1230\rC\r", 0);
    THEN("it does nothing it was told, and goes on afterwards") {
      for (int i = 0; i < 2; ++i) {  // between the two it has read the commands
        adapter.say("x");
        CHECK(terminal.hear(1) == "x");
      }
      CHECK(adapter.is_channel_open());
      adapter.inject(sim::SlcanFault::none);
      CHECK(terminal.ask("t1230\r", 2) == "z\r");
      CHECK(adapter.frames_to_bus() == 1);
    }
  }
  WHEN("it says what nobody asked for") {
    adapter.say("e1a\r");
    CHECK(terminal.hear(4) == "e1a\r");
  }
}
