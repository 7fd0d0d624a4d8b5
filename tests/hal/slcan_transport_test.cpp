#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <stdexcept>
#include <vector>

#include "hal/can/can_brake.hpp"
#include "hal/can/can_dispatcher.hpp"
#include "hal/can/can_torque_sensor.hpp"
#include "sim/brake_node.hpp"
#include "sim/transducer_node.hpp"
#include "tests/hal/slcan_bench.hpp"

using namespace rvbench;
using hal::SlcanTransport;
using test::counted;
using test::must_open;
using test::next;
using test::numbered;
using test::send_next;
using test::wait_until;

SCENARIO("a serial adapter carries frames both ways", "[hal][can]") {
  test::SlcanBench bench;
  SlcanTransport can(bench.options({0x181, 0x281}), bench.clock);
  CHECK(can.receive().error().code == IoErrc::disconnected);
  CHECK(can.send(numbered(0x201, 1)).error().code == IoErrc::disconnected);
  REQUIRE(bench.bus.nodes->send(numbered(0x281, 99)));
  must_open(can);
  CHECK(bench.adapter->bitrate_code() == 5);
  CHECK(bench.adapter->is_channel_open());
  THEN("only the identifiers come in that were asked for, none from before it was opened") {
    const double sent_s = bench.clock.now_s();
    REQUIRE(bench.bus.nodes->send(numbered(0x280, 1)));
    REQUIRE(bench.bus.nodes->send(numbered(0x281, 2)));
    REQUIRE(bench.bus.nodes->send(numbered(0x181, 3)));
    const auto first = next(can);
    REQUIRE(first);
    CHECK(first.value().id == 0x281);
    CHECK(first.value().data[0] == 2);
    CHECK(first.value().time_s >= sent_s);
    CHECK(first.value().time_s <= bench.clock.now_s());
    CHECK(next(can).value().id == 0x181);
    CHECK(can.receive().error().code == IoErrc::timeout);
  }
  THEN("what waits in the line is dropped when it is opened anew") {
    const int heard = bench.adapter->frames_from_bus();
    REQUIRE(bench.bus.nodes->send(numbered(0x281, 7)));
    REQUIRE(wait_until([&] { return bench.adapter->frames_from_bus() > heard; }));
    must_open(can);
    REQUIRE(bench.bus.nodes->send(numbered(0x281, 8)));
    CHECK(next(can).value().data[0] == 8);
  }
  THEN("what is sent reaches the nodes, in order") {
    for (std::uint8_t i = 0; i < 50; ++i) {
      REQUIRE(send_next(can, {.id = 0x201, .length = 4, .data = {i, 0, 1, i}}));
      const auto heard = next(*bench.bus.nodes);
      REQUIRE(heard);
      CHECK(heard.value().id == 0x201);
      CHECK(heard.value().length == 4);
      CHECK(heard.value().data == std::array<std::uint8_t, 8>{i, 0, 1, i});
    }
    CHECK(bench.adapter->frames_to_bus() == 50);
  }
}

SCENARIO("no setpoint waits behind another in a serial adapter", "[hal][can]") {
  test::SlcanBench bench;
  SlcanTransport can(bench.options(), bench.clock);
  must_open(can);
  bench.adapter->inject(sim::SlcanFault::slow_ack);
  REQUIRE(can.send(numbered(0x201, 1)));
  const double sent_s = bench.clock.now_s();
  double shortest_s = 1;  // of many, since the computer may be busy
  while (bench.clock.now_s() - sent_s < 0.25) {
    const double start_s = bench.clock.now_s();
    const auto second = can.send(numbered(0x201, 2));
    shortest_s = std::min(shortest_s, bench.clock.now_s() - start_s);
    REQUIRE_FALSE(second);
    CHECK(second.error().code == IoErrc::timeout);
    CHECK_THAT(second.error().where, Catch::Contains("not acknowledged"));
  }
  CHECK(shortest_s < 0.01);
  THEN("the next one goes once the first is acknowledged") {
    REQUIRE(send_next(can, numbered(0x201, 3)));
    CHECK(next(*bench.bus.nodes).value().data[0] == 1);
    CHECK(next(*bench.bus.nodes).value().data[0] == 3);
  }
}

SCENARIO("a serial adapter that is lost does not come back by itself", "[hal][can]") {
  test::SlcanBench bench;
  SlcanTransport can(bench.options(), bench.clock);
  must_open(can);
  struct Case {
    sim::SlcanFault fault;
    const char* says;
    const char* why;
  };
  const auto what = GENERATE(Case{sim::SlcanFault::silent, "", "silent"},
                             Case{sim::SlcanFault::bus_off, "", "bus-off"},
                             Case{sim::SlcanFault::none, "sb000256\r", "bus-off"});
  INFO("fault " << static_cast<int>(what.fault) << ", says " << what.says);
  bench.adapter->inject(what.fault);
  bench.adapter->say(what.says);
  const auto lost = next(can);
  REQUIRE_FALSE(lost);
  CHECK(lost.error().code == IoErrc::disconnected);
  CHECK_THAT(lost.error().where, Catch::Contains(what.why));
  bench.adapter->inject(sim::SlcanFault::none);
  REQUIRE(bench.bus.nodes->send(numbered(0x281, 1)));
  CHECK(can.receive().error().code == IoErrc::disconnected);
  CHECK(can.send(numbered(0x201, 1)).error().code == IoErrc::disconnected);
  THEN("it can be opened anew") {
    must_open(can);
    REQUIRE(can.send(numbered(0x201, 2)));
    CHECK(next(*bench.bus.nodes).value().data[0] == 2);
    REQUIRE(bench.bus.nodes->send(numbered(0x281, 3)));
    CHECK(next(can).value().data[0] == 3);
  }
}

TEST_CASE("a serial adapter that is unplugged is lost", "[hal][can]") {
  test::SlcanBench bench;
  SlcanTransport can(bench.options(), bench.clock);
  must_open(can);
  bench.adapter.reset();
  const auto lost = next(can);
  REQUIRE_FALSE(lost);
  CHECK(lost.error().code == IoErrc::disconnected);
  CHECK_THAT(lost.error().where, Catch::Contains("hung up"));
}

TEST_CASE("a serial adapter leaves the bus with whoever opened it", "[hal][can]") {
  test::SlcanBench bench;
  {
    SlcanTransport can(bench.options(), bench.clock);
    must_open(can);
  }
  CHECK(wait_until([&] { return !bench.adapter->is_channel_open(); }));
}

SCENARIO("what a serial adapter loses is told once, and counted", "[hal][can]") {
  test::SlcanBench bench;
  SlcanTransport can(bench.options(), bench.clock);
  const auto monitor = can.monitor();
  CHECK(monitor->read().error().code == IoErrc::disconnected);
  must_open(can);
  const hal::BusCounters before = test::counters(*monitor);
  CHECK(before.interface == bench.adapter->device());
  for (const auto& [name, count] : before.counts) {
    INFO(name);
    CHECK(count == 0);
  }
  WHEN("frames are lost in its queue") {
    bench.adapter->raise_flags(0x08);
    CHECK(next(can).error().code == IoErrc::overrun);
    THEN("it goes on, and the count stays") {
      REQUIRE(bench.bus.nodes->send(numbered(0x281, 1)));
      CHECK(next(can).value().data[0] == 1);
      CHECK(counted(*monitor, "data_overrun") == 1);
    }
  }
  WHEN("its queue is full, for nobody fetches what it hears") {
    bench.adapter->raise_flags(0x01);
    CHECK(next(can).error().code == IoErrc::overrun);
    CHECK(counted(*monitor, "receive_queue_full") == 1);
  }
  WHEN("the bus has errors, or a frame had to wait for another") {
    bench.adapter->raise_flags(0xC4);
    THEN("only the errors count") {
      CHECK(counted(*monitor, "bus_error") == 1);
      CHECK(counted(*monitor, "error_warning") == 1);
      CHECK_FALSE(test::counters(*monitor).counts.contains("arbitration_lost"));
    }
    AND_WHEN("it says an error that nobody asked for") {
      bench.adapter->say("e1c\r");
      CHECK(counted(*monitor, "bus_error") >= 1);
    }
  }
  WHEN("what it says is garbled") {
    bench.adapter->inject(sim::SlcanFault::garbled);
    REQUIRE(bench.bus.nodes->send(numbered(0x281, 1)));
    CHECK(next(can).error().code == IoErrc::bad_reply);
    bench.adapter->inject(sim::SlcanFault::none);
    must_open(can);
    CHECK(counted(*monitor, "garbled_lines") > 0);
  }
  WHEN("it answers what nobody asked") {
    bench.adapter->say("z\r");
    CHECK(next(can).error().code == IoErrc::bad_reply);
    CHECK(counted(*monitor, "stray_answers") == 1);
  }
  WHEN("it does not tell its flags when they are to be counted") {
    bench.adapter->inject(sim::SlcanFault::silent);
    const auto none = monitor->read();
    REQUIRE_FALSE(none);
    CHECK(none.error().code == IoErrc::timeout);
  }
}

TEST_CASE("a serial adapter's counters may be read while frames pass", "[hal][can]") {
  test::SlcanBench bench;
  SlcanTransport can(bench.options(), bench.clock);
  const auto monitor = can.monitor();
  must_open(can);
  std::atomic<int> counted_times = 0;
  std::jthread reader([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      if (monitor->read()) ++counted_times;
    }
  });
  for (int i = 0; i < 20 || counted_times < 5; ++i) {
    const auto number = static_cast<std::uint8_t>(i);
    REQUIRE(bench.bus.nodes->send(numbered(0x281, number)));
    CHECK(next(can).value().data[0] == number);
    REQUIRE(send_next(can, numbered(0x201, number)));
    CHECK(next(*bench.bus.nodes).value().data[0] == number);
  }
}

SCENARIO("transducer and brake work through a serial adapter", "[hal][can]") {
  test::SlcanBench bench;
  std::jthread plant([&](const std::stop_token& stop) {
    sim::TransducerNode transducer(*bench.bus.nodes, 500);
    sim::BrakeNode brake(*bench.bus.nodes, {});
    while (!stop.stop_requested()) {
      const double now_s = bench.clock.now_s();
      transducer.advance_to(now_s, 12.5, 100 * now_s);
      brake.advance_to(now_s, brake.setpoint_Nm());
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  auto ports = hal::split_by_id(
      std::make_unique<SlcanTransport>(bench.options({0x181, 0x281}), bench.clock), {0x181, 0x281});
  hal::CanTorqueSensor sensor(std::move(ports[0]), {.deadline_s = 2}, bench.clock);
  hal::CanBrake brake(std::move(ports[1]), {.deadline_s = 2}, bench.clock);
  REQUIRE(sensor.connect());
  REQUIRE(brake.connect());
  REQUIRE(brake.set_torque(125));
  CHECK(wait_until([&] {
    const auto status = brake.read();
    REQUIRE(status);
    return status.value().torque_Nm == 125;
  }));
  const auto block = sensor.read();
  REQUIRE(block);
  REQUIRE_FALSE(block.value().samples.empty());
  CHECK(block.value().samples.back().torque_Nm == Approx(12.5));
}

TEST_CASE("options of a serial adapter that cannot be are the caller's bug", "[hal][can]") {
  hal::SteadyClock clock;
  const auto make = [&](const hal::SlcanOptions& options) { SlcanTransport can(options, clock); };
  CHECK_THROWS_AS(make({}), std::invalid_argument);
  CHECK_THROWS_AS(make({.device = "/dev/ttyUSB0", .bitrate_kbit_s = 200}), std::invalid_argument);
  CHECK_THROWS_AS(make({.device = "/dev/ttyUSB0", .baud = 12345}), std::invalid_argument);
  CHECK_THROWS_AS(make({.device = "/dev/ttyUSB0", .ids = {0x800}}), std::invalid_argument);
  CHECK_NOTHROW(make({.device = "/dev/ttyUSB0"}));
}
