#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <string>

#include "tests/hal/slcan_bench.hpp"

using namespace rvbench;
using hal::SlcanTransport;
using test::counted;
using test::must_open;
using test::next;
using test::numbered;
using test::send_next;

SCENARIO("an adapter that cannot be relied on is not opened", "[hal][can]") {
  hal::SteadyClock clock;
  const auto open = [&](const std::string& device) {
    SlcanTransport can({.device = device}, clock);
    const Status opened = can.open();
    REQUIRE_FALSE(opened);
    CHECK_THAT(opened.error().where, Catch::Contains(device));
    CHECK(can.receive().error().code == IoErrc::disconnected);
    return opened.error();
  };
  const auto declines = [](char what) {
    return [what](const std::string& command) {
      return !command.empty() && command[0] == what ? "\a" : test::sound_answer(command);
    };
  };
  CHECK(open("/dev/nosuchtty").code == IoErrc::disconnected);
  CHECK(open("/dev/null").code == IoErrc::disconnected);
  test::OddAdapter no_flags(declines('F')), other_bitrate(declines('S')), in_use(declines('O'));
  CHECK(open(no_flags.device()).code == IoErrc::refused);
  CHECK_THAT(open(no_flags.device()).where, Catch::Contains("status flags"));
  CHECK(open(other_bitrate.device()).code == IoErrc::refused);
  CHECK_THAT(open(other_bitrate.device()).where, Catch::Contains("bit rate"));
  CHECK(open(in_use.device()).code == IoErrc::refused);
  test::OddAdapter silent([](const std::string&) { return ""; });
  const double start_s = clock.now_s();
  CHECK(open(silent.device()).code == IoErrc::timeout);
  CHECK(clock.now_s() - start_s < 3);  // 2 s, and what a busy computer adds
}

SCENARIO("an adapter that another program has is no silent one", "[hal][can]") {
  hal::SteadyClock clock;
  test::OddAdapter adapter(test::sound_answer);
  SlcanTransport can({.device = adapter.device()}, clock);
  const int other = ::open(adapter.device().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  REQUIRE(::flock(other, LOCK_EX | LOCK_NB) == 0);
  const Status opened = can.open();
  REQUIRE_FALSE(opened);
  CHECK(opened.error().code == IoErrc::disconnected);
  CHECK_THAT(opened.error().where,
             Catch::Contains(adapter.device()) && Catch::Contains("another program has the line"));
  ::close(other);
  must_open(can);
}

SCENARIO("an adapter of another make is understood", "[hal][can]") {
  hal::SteadyClock clock;
  WHEN("it acknowledges frames with CR alone, and declines to close what is closed") {
    test::OddAdapter adapter([](const std::string& command) -> std::string {
      if (command == "C" || command.empty()) return "\a";
      return command[0] == 't' ? "\r" : test::sound_answer(command);
    });
    SlcanTransport can({.device = adapter.device()}, clock);
    must_open(can);
    CHECK(can.send(numbered(0x201, 1)));
    CHECK(send_next(can, numbered(0x201, 2)));
  }
  WHEN("its answer to a frame looks like one to what comes next") {
    std::atomic<bool> is_on_bus = false;
    test::OddAdapter adapter(
        [&](const std::string& command) -> std::string {
          if (command == "O" || command == "C") is_on_bus = command == "O";
          return command[0] == 't' ? "\r" : test::sound_answer(command);
        },
        std::chrono::milliseconds(5));
    {
      SlcanTransport can({.device = adapter.device()}, clock);
      must_open(can);
      CHECK(is_on_bus);
      CHECK(can.send(numbered(0x201, 1)));
    }
    CHECK_FALSE(is_on_bus);
  }
  WHEN("it declines a frame") {
    test::OddAdapter adapter([](const std::string& command) -> std::string {
      return command.starts_with('t') ? "\a" : test::sound_answer(command);
    });
    SlcanTransport can({.device = adapter.device()}, clock);
    const auto monitor = can.monitor();
    must_open(can);
    CHECK(can.send(numbered(0x201, 1)));
    CHECK(next(can).error().code == IoErrc::overrun);
    CHECK(counted(*monitor, "send_declined") == 1);
    CHECK(can.send(numbered(0x201, 2)));
  }
  WHEN("it never acknowledges a frame") {
    test::OddAdapter adapter([](const std::string& command) -> std::string {
      return command.starts_with('t') ? "" : test::sound_answer(command);
    });
    SlcanTransport can({.device = adapter.device()}, clock);
    must_open(can);
    CHECK(can.send(numbered(0x201, 1)));
    CHECK(next(can).error().code == IoErrc::disconnected);
  }
  WHEN("it has lost power for a moment, and its channel is closed") {
    std::atomic<int> flags_told = 0;
    test::OddAdapter adapter([&](const std::string& command) -> std::string {
      return command == "F" && flags_told++ > 0 ? "\a" : test::sound_answer(command);
    });
    SlcanTransport can({.device = adapter.device()}, clock);
    must_open(can);
    const auto lost = next(can);
    REQUIRE_FALSE(lost);
    CHECK(lost.error().code == IoErrc::disconnected);
    CHECK_THAT(lost.error().where, Catch::Contains("channel"));
  }
}
