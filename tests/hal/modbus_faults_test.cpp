#include <catch2/catch.hpp>
#include <thread>

#include "tests/hal/modbus_bench.hpp"
#include "tests/support/wait_until.hpp"

using namespace rvbench;
using sim::WireFault;
using Bench = test::ModbusBench;
using test::real_seconds;
using test::response_timeout_s;

SCENARIO("a late reply is never taken for the next one", "[hal][modbus]") {
  Bench bench;
  REQUIRE(bench.drive.connect());
  test::check_late_replies(bench.drive, bench.model, *bench.server);
}

SCENARIO("an older reply that comes merged with the right one is not taken", "[hal][modbus]") {
  Bench bench;
  REQUIRE(bench.drive.connect());
  bench.model.set_measured(100, 0);
  REQUIRE(bench.drive.read());
  for (int i = 2; i <= 5; ++i) {
    bench.model.set_measured(100 * i, 0);
    bench.server->inject({.fault = WireFault::merged, .requests = 1});
    const auto status = bench.drive.read();
    REQUIRE(status);
    CHECK(status.value().speed_rpm == 100 * i);
  }
  CHECK(bench.server->misbehaved() == 4);
  CHECK(bench.drive.retries() == 4);
}

SCENARIO("every exception is told as a refusal", "[hal][modbus]") {
  Bench bench;
  REQUIRE(bench.drive.connect());
  for (const int code : {1, 2, 3, 4, 5, 6, 8, 10, 11}) {
    CAPTURE(code);
    bench.server->inject({.fault = WireFault::busy, .exception_code = code});
    const auto status = bench.drive.read();
    REQUIRE_FALSE(status);
    CHECK(status.error().code == IoErrc::refused);
    bench.server->inject({});
    CHECK(bench.drive.read());
  }
}

SCENARIO("a silent drive is an error within the deadline", "[hal][modbus]") {
  Bench bench({.comm_loss_timeout_s = 0.5});
  REQUIRE(bench.drive.connect());
  REQUIRE(bench.drive.set_speed(900));
  bench.wait_s(0.4);
  const double start_Hz = bench.model.output_frequency_Hz();
  REQUIRE(start_Hz == Approx(8).margin(0.05));
  bench.server->inject({.fault = WireFault::silent});
  WHEN("its status is read") {
    const double before_s = bench.clock.now_s();
    const double took_s = real_seconds([&] {
      const auto status = bench.drive.read();
      REQUIRE_FALSE(status);
      CHECK(status.error().code == IoErrc::timeout);
    });
    THEN("the call ends in time") { CHECK(took_s < 4 * response_timeout_s + 0.1); }
    THEN("virtual time has passed for each time-out: for the reading and for identifying anew") {
      CHECK(bench.clock.now_s() - before_s == Approx(2 * response_timeout_s).margin(0.002));
    }
  }
  WHEN("one keeps asking") {
    double tripped_s = 0;
    const double lost_s = bench.clock.now_s() - 0.4;  // the last valid request was the setpoint
    for (int i = 0; i < 20 && tripped_s == 0; ++i) {
      CHECK_FALSE(bench.drive.read());
      if (bench.model.state().tripped) tripped_s = bench.clock.now_s();
    }
    THEN("the drive's own watchdog runs out in virtual time and stops the motor") {
      CHECK(tripped_s - lost_s == Approx(0.5).margin(2 * response_timeout_s + 0.002));
      bench.wait_s(1);
      CHECK(bench.model.output_frequency_Hz() == 0);
      CHECK_FALSE(bench.model.output_enabled());
    }
  }
}

SCENARIO("a garbled reply is told, and does not spoil the next", "[hal][modbus]") {
  Bench bench;
  REQUIRE(bench.drive.connect());
  bench.model.set_measured(600, 1);
  WHEN("one reply is garbled") {
    bench.server->inject({.fault = WireFault::garbled, .requests = 1});
    THEN("the reading is sent again, once") {
      const auto status = bench.drive.read();
      REQUIRE(status);
      CHECK(status.value().speed_rpm == 600);
      CHECK(bench.drive.retries() == 1);
    }
  }
  WHEN("all replies are garbled, and then no more") {
    bench.server->inject({.fault = WireFault::garbled});
    const auto garbled = bench.drive.read();
    bench.server->inject({});
    THEN("that reading fails and the next succeeds") {
      REQUIRE_FALSE(garbled);
      CHECK(garbled.error().code == IoErrc::bad_reply);
      CHECK(bench.drive.read());
    }
  }
}

SCENARIO("a setpoint that failed is never replayed", "[hal][modbus]") {
  Bench bench;
  REQUIRE(bench.drive.connect());
  REQUIRE(bench.drive.set_speed(300));
  const WireFault fault = GENERATE(WireFault::busy, WireFault::silent, WireFault::dead);
  bench.server->inject({.fault = fault, .requests = 1});
  const auto set = bench.drive.set_speed(600);
  REQUIRE_FALSE(set);
  bench.server->inject({});
  REQUIRE(bench.drive.read());
  REQUIRE(bench.drive.read_watchdog());
  CHECK(bench.model.state().setpoint_Hz == Approx(10));
  CHECK(set.error().code == (fault == WireFault::busy     ? IoErrc::refused
                             : fault == WireFault::silent ? IoErrc::timeout
                                                          : IoErrc::disconnected));
}

SCENARIO("what does not say who it is gets no command", "[hal][modbus]") {
  Bench bench;
  REQUIRE(bench.drive.connect());
  REQUIRE(bench.drive.set_speed(300));
  GIVEN("a new link over which the drive was too busy to be identified") {
    bench.server->inject({.fault = WireFault::silent, .requests = 1});
    REQUIRE_FALSE(bench.drive.set_speed(600));  // a time-out: the link is closed
    bench.server->inject({.fault = WireFault::busy, .requests = 1});
    const auto refused = bench.drive.set_speed(600);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code == IoErrc::refused);
    CHECK_THAT(refused.error().where, Catch::Contains("identify"));
    bench.server->inject({});
    const int before = bench.server->requests();
    WHEN("the next setpoint is sent") {
      REQUIRE(bench.drive.set_speed(600));
      THEN("the drive was asked for its identity first") {
        CHECK(bench.server->requests() - before == 2);
        CHECK(bench.model.state().setpoint_Hz == Approx(20));
      }
    }
  }
}

SCENARIO("a dead link neither blocks nor breaks anything", "[hal][modbus]") {
  Bench bench;
  REQUIRE(bench.drive.connect());
  REQUIRE(bench.drive.set_speed(600));
  WHEN("the drive closes every connection") {
    bench.server->inject({.fault = WireFault::dead});
    THEN("a reading says so at once") {
      const auto status = bench.drive.read();
      REQUIRE_FALSE(status);
      CHECK(status.error().code == IoErrc::disconnected);
    }
    THEN("stop tries, and returns") {
      CHECK(real_seconds([&] { bench.drive.stop(); }) < 4 * response_timeout_s + 0.1);
      CHECK(bench.model.state().run == sim::RunCommand::forward);
    }
    THEN("a stop after it has come back arrives") {
      CHECK_FALSE(bench.drive.read());
      bench.server->inject({});
      bench.drive.stop();
      CHECK(bench.model.state().run == sim::RunCommand::stop);
    }
  }
  WHEN("one stop is lost on the way") {
    bench.server->inject({.fault = WireFault::silent, .requests = 1});
    bench.drive.stop();
    THEN("it is sent once more") { CHECK(bench.model.state().run == sim::RunCommand::stop); }
  }
}

SCENARIO("stop may come from another thread while a reading waits for its reply", "[hal][modbus]") {
  Bench bench;
  REQUIRE(bench.drive.connect());
  REQUIRE(bench.drive.set_speed(600));
  bench.server->inject({.fault = WireFault::silent, .requests = 1});
  std::thread reader([&] { (void)bench.drive.read(); });
  const bool reads = test::wait_until([&] { return bench.server->requests() >= 5; });
  const double took_s = real_seconds([&] { bench.drive.stop(); });
  reader.join();
  CHECK(reads);  // connect 3, set 1, read 1
  CHECK(bench.drive.retries() == 0);
  CHECK(bench.model.state().run == sim::RunCommand::stop);
  CHECK(took_s < 4 * response_timeout_s + 0.1);
}
