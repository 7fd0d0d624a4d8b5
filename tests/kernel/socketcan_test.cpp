#include <memory>
#include <string>
#include <vector>

#include "hal/can/can_brake.hpp"
#include "hal/can/socketcan_counters.hpp"
#include "hal/can/socketcan_transport.hpp"
#include "tests/kernel/can_interface.hpp"
#include "tests/support/program.hpp"

using namespace rvbench;
using hal::SocketcanCounters;
using hal::SocketcanTransport;
using test::next;
using test::numbered;
using test::shell;

TEST_CASE("two ends exchange frames, each hearing only what it asked for") {
  hal::SteadyClock clock;
  SocketcanTransport bench("vcan0", {0x281}, clock);
  SocketcanTransport node("vcan0", {0x201}, clock);
  REQUIRE(bench.open());
  REQUIRE(node.open());
  REQUIRE(node.send(numbered(0x181, 1)));
  REQUIRE(node.send(numbered(0x281, 2)));
  REQUIRE(bench.send(numbered(0x201, 3)));
  CHECK(next(bench).value().data[0] == 2);
  CHECK(bench.receive().error().code == IoErrc::timeout);
  CHECK(next(node).value().data[0] == 3);
}

TEST_CASE("frames of can-utils arrive as they were sent, and nothing that only looks alike") {
  hal::SteadyClock clock;
  SocketcanTransport bench("vcan0", {0x281}, clock);
  REQUIRE(bench.open());
  shell("cansend vcan0 00000281#EE");  // 29 bits
  shell("cansend vcan0 281#R");        // a request for a frame
  shell("cansend vcan0 280#EE");
  shell("cansend vcan0 281#0102030405060708");
  const auto frame = next(bench);
  REQUIRE(frame);
  CHECK(frame.value().id == 0x281);
  CHECK(frame.value().length == 8);
  CHECK(frame.value().data == std::array<std::uint8_t, 8>{1, 2, 3, 4, 5, 6, 7, 8});
  CHECK(bench.receive().error().code == IoErrc::timeout);
}

TEST_CASE("can-utils see the frames that we send") {
  hal::SteadyClock clock;
  SocketcanTransport bench("vcan0", {}, clock);
  REQUIRE(bench.open());
  test::Program dump(".", {"/usr/bin/candump", "-n", "1", "-T", "5000", "vcan0,201:7FF"});
  // candump does not say when it listens: it gets the frame again until it has ended.
  std::jthread sender([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      (void)bench.send({.id = 0x201, .length = 3, .data = {0xA1, 0xB2, 0xC3}});
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  });
  CHECK_THAT(dump.wait().out, Catch::Contains("201   [3]  A1 B2 C3"));
}

TEST_CASE("a frame has the time at which it came, not at which it was fetched") {
  hal::SteadyClock clock;
  SocketcanTransport bench("vcan0", {0x281}, clock);
  SocketcanTransport node("vcan0", {}, clock);
  REQUIRE(bench.open());
  REQUIRE(node.open());
  const double sent_s = clock.now_s();
  REQUIRE(node.send(numbered(0x281, 1)));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const auto frame = next(bench);
  REQUIRE(frame);
  CHECK(frame.value().time_s - sent_s < 0.1);
  CHECK(frame.value().time_s - sent_s > -0.01);
}

TEST_CASE("a flood that nobody reads is told as loss, once, and then goes on") {
  hal::SteadyClock clock;
  SocketcanTransport bench("vcan0", {0x281}, clock);
  SocketcanTransport node("vcan0", {}, clock);
  REQUIRE(bench.open());
  REQUIRE(node.open());
  for (int i = 0; i < 5000; ++i) REQUIRE(node.send(numbered(0x281, 1)));
  int frames = 0, losses = 0;
  for (auto got = bench.receive();; got = bench.receive()) {
    if (got) {
      ++frames;
    } else if (got.error().code == IoErrc::overrun) {
      ++losses;
    } else {
      break;
    }
  }
  CHECK(frames < 5000);
  // The kernel tells of the loss with the first frame behind it.
  REQUIRE(node.send(numbered(0x281, 2)));
  CHECK(next(bench).error().code == IoErrc::overrun);
  REQUIRE(node.send(numbered(0x281, 3)));
  CHECK(next(bench).value().data[0] == 3);
  CHECK(losses == 0);
}

SCENARIO("an interface that goes down is lost until it is opened again") {
  hal::SteadyClock clock;
  SocketcanTransport bench("vcan0", {0x281}, clock);
  REQUIRE(bench.open());
  shell("ip link set vcan0 down");
  const auto lost = next(bench);
  REQUIRE_FALSE(lost);
  CHECK(lost.error().code == IoErrc::disconnected);
  const auto sent = bench.send(numbered(0x201, 1));
  REQUIRE_FALSE(sent);
  CHECK(sent.error().code == IoErrc::disconnected);
  shell("ip link set vcan0 up");
  REQUIRE(bench.open());
  CHECK(bench.send(numbered(0x201, 1)));
}

SCENARIO("a brake whose link was lost is released once it can be reached", "[safety]") {
  hal::SteadyClock clock;
  SocketcanTransport node("can1", {0x201}, clock);
  REQUIRE(node.open());
  hal::CanBrake brake(
      std::make_unique<SocketcanTransport>("can0", std::vector<std::uint32_t>{0x281}, clock), {},
      clock);
  const auto is_told_to_release = [&] {
    const auto frame = next(node);
    return frame && frame.value().data[2] == 0;
  };
  CHECK(brake.connect().error().code == IoErrc::timeout);  // it is told, and does not answer
  REQUIRE(is_told_to_release());
  shell("ip link set can0 down");
  CHECK(brake.release().error().code == IoErrc::disconnected);
  CHECK(brake.release().error().code == IoErrc::disconnected);
  CHECK(node.receive().error().code == IoErrc::timeout);
  shell("ip link set can0 up");
  CHECK(brake.release());
  CHECK(is_told_to_release());
}

SCENARIO("a controller that went bus-off is lost until it is opened again") {
  hal::SteadyClock clock;
  SocketcanTransport bench("vcan0", {0x281}, clock);
  REQUIRE(bench.open());
  shell("cansend vcan0 20000040#0000000000000000");  // as the kernel tells it
  const auto lost = next(bench);
  REQUIRE_FALSE(lost);
  CHECK(lost.error().code == IoErrc::disconnected);
  CHECK_THAT(lost.error().where, Catch::Contains("bus-off"));
  CHECK(bench.send(numbered(0x201, 1)).error().code == IoErrc::disconnected);
  REQUIRE(bench.open());
  CHECK(bench.send(numbered(0x201, 1)));
}

SCENARIO("a controller that loses frames stays as silent as it was", "[safety]") {
  hal::SteadyClock clock;
  SocketcanTransport bench("vcan0", {0x281}, clock);
  const auto tell = [&](const std::string& state) {
    shell("cansend vcan0 20000004#00" + state + "000000000000");
  };
  const auto code_of_full_queue = [&] {
    shell("tc qdisc replace dev vcan0 root netem delay 60s limit 1 && cansend vcan0 123#01");
    const auto sent = bench.send(numbered(0x201, 1));
    shell("tc qdisc delete dev vcan0 root");
    REQUIRE_FALSE(sent);
    return sent.error().code;
  };
  REQUIRE(bench.open());
  tell("20");  // it sends no more errors: nobody answers
  CHECK(bench.receive().error().code == IoErrc::timeout);
  WHEN("it loses a frame that it received") {
    tell("01");
    CHECK(bench.receive().error().code == IoErrc::overrun);
    THEN("a full queue is a lost bus as before") {
      CHECK(code_of_full_queue() == IoErrc::disconnected);
    }
  }
  WHEN("it is well again") {
    tell("40");
    CHECK(bench.receive().error().code == IoErrc::timeout);
    THEN("a full queue is only full") { CHECK(code_of_full_queue() == IoErrc::overrun); }
  }
}

TEST_CASE("two controllers on one bus exchange frames at 250 kbit/s") {
  hal::SteadyClock clock;
  SocketcanTransport bench("can0", {0x281}, clock);
  SocketcanTransport node("can1", {0x201}, clock);
  REQUIRE(bench.open());
  REQUIRE(node.open());
  for (std::uint8_t i = 0; i < 100; ++i) {
    REQUIRE(bench.send(numbered(0x201, i)));
    CHECK(next(node).value().data[0] == i);
    REQUIRE(node.send(numbered(0x281, i)));
    CHECK(next(bench).value().data[0] == i);
  }
}

SCENARIO("no setpoint waits in a queue behind another") {
  hal::SteadyClock clock;
  SocketcanTransport bench("can0", {}, clock);
  SocketcanTransport node("can1", {0x201}, clock);
  REQUIRE(bench.open());
  REQUIRE(node.open());
  shell("tc qdisc replace dev can0 root netem delay 100ms");
  REQUIRE(bench.send(numbered(0x201, 1)));
  const auto second = bench.send(numbered(0x201, 2));
  REQUIRE_FALSE(second);
  CHECK(second.error().code == IoErrc::timeout);
  CHECK_THAT(second.error().where, Catch::Contains("still on its way"));
  CHECK(next(node).value().data[0] == 1);
  THEN("the next one goes as soon as the first is on the bus") {
    CHECK(bench.send(numbered(0x201, 3)));
    CHECK(next(node).value().data[0] == 3);
  }
  shell("tc qdisc delete dev can0 root");
}

SCENARIO("a link is not opened anew while an old setpoint may still be sent") {
  hal::SteadyClock clock;
  SocketcanTransport bench("can0", {}, clock);
  SocketcanTransport node("can1", {0x201}, clock);
  REQUIRE(bench.open());
  REQUIRE(node.open());
  const auto send_late = [&](const std::string& delay) {
    shell("tc qdisc replace dev can0 root netem delay " + delay);
    REQUIRE(bench.send(numbered(0x201, 1)));
    const auto opened = bench.open();
    REQUIRE_FALSE(opened);
    CHECK(opened.error().code == IoErrc::timeout);
    CHECK_THAT(opened.error().where, Catch::Contains("from before"));
  };
  WHEN("it has been on the bus") {
    send_late("500ms");
    CHECK(next(node).value().data[0] == 1);
    CHECK(bench.open());
    shell("tc qdisc delete dev can0 root");
  }
  WHEN("the interface went down, and dropped it") {
    send_late("60s");
    shell("ip link set can0 down && tc qdisc delete dev can0 root && ip link set can0 up");
    REQUIRE(bench.open());
    REQUIRE(bench.send(numbered(0x201, 2)));
    CHECK(next(node).value().data[0] == 2);
  }
}

SCENARIO("a full send queue is no lost bus") {
  hal::SteadyClock clock;
  SocketcanTransport bench("can0", {}, clock);
  SocketcanTransport node("can1", {0x201}, clock);
  REQUIRE(bench.open());
  REQUIRE(node.open());
  shell("tc qdisc replace dev can0 root netem delay 60s limit 1");
  shell("cansend can0 123#01");
  const auto sent = bench.send(numbered(0x201, 1));
  REQUIRE_FALSE(sent);
  CHECK(sent.error().code == IoErrc::overrun);
  shell("tc qdisc delete dev can0 root");
  THEN("it goes on when there is room") {
    REQUIRE(bench.send(numbered(0x201, 2)));
    CHECK(next(node).value().data[0] == 2);
  }
}

SCENARIO("the kernel's counters of an interface tell what went wrong on it") {
  hal::SteadyClock clock;
  const auto counts = [](const char* interface) {
    const auto counters = SocketcanCounters(interface).read();
    REQUIRE(counters);
    CHECK(counters.value().interface == interface);
    return counters.value().counts;
  };
  GIVEN("two controllers on one bus") {
    SocketcanTransport bench("can0", {0x281}, clock);
    SocketcanTransport node("can1", {0x201}, clock);
    REQUIRE(bench.open());
    REQUIRE(node.open());
    const auto before = counts("can0");
    for (const char* name : {"bus_error", "error_passive", "bus_off", "restarts", "rx_dropped"}) {
      INFO(name);
      CHECK(before.contains(name));
    }
    THEN("frames in good order move none of them") {
      for (std::uint8_t i = 0; i < 100; ++i) {
        REQUIRE(bench.send(numbered(0x201, i)));
        REQUIRE(node.send(numbered(0x281, i)));
        REQUIRE(next(bench));
        REQUIRE(next(node));
      }
      CHECK(counts("can0") == before);
    }
    THEN("a frame that the controller may not send is counted") {
      shell("ip link set can0 down && ip link set can0 type can listen-only on");
      shell("ip link set can0 up && cansend can0 201#01");
      CHECK(counts("can0").at("tx_dropped") == before.at("tx_dropped") + 1);
      shell("ip link set can0 down && ip link set can0 type can listen-only off");
      shell("ip link set can0 up");
    }
  }
  GIVEN("an interface without a controller") {
    THEN("it has those of any interface") {
      CHECK(counts("vcan0").contains("rx_errors"));
      CHECK_FALSE(counts("vcan0").contains("bus_off"));
    }
  }
  GIVEN("no interface") {
    const auto none = SocketcanCounters("can9").read();
    REQUIRE_FALSE(none);
    CHECK(none.error().code == IoErrc::disconnected);
  }
}
