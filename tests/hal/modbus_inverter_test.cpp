#include "hal/modbus/modbus_inverter.hpp"

#include <catch2/catch.hpp>
#include <memory>
#include <stdexcept>

#include "tests/hal/modbus_bench.hpp"

using namespace rvbench;
using Bench = test::ModbusBench;
using test::response_timeout_s;

SCENARIO("driver and drive agree on a setpoint by what they do", "[hal][modbus]") {
  Bench bench;
  REQUIRE(bench.drive.connect());
  WHEN("605 rpm are commanded to a motor with 2 pole pairs") {
    REQUIRE(bench.drive.set_speed(605));
    THEN("the drive's setpoint is 605/60·2 Hz, to its resolution, and it runs forward") {
      CHECK(bench.model.state().setpoint_Hz == Approx(20.1667).margin(0.005));
      CHECK(bench.model.state().run == sim::RunCommand::forward);
    }
    THEN("half a second later the output has ramped to half of 20 Hz/s, and reads so") {
      bench.wait_s(0.5);
      const auto status = bench.drive.read();
      REQUIRE(status);
      CHECK(status.value().output_frequency_Hz == Approx(10).margin(0.025));
      CHECK(status.value().running);
      CHECK_FALSE(status.value().tripped);
    }
  }
}

SCENARIO("driver and drive agree on a reading by what they do", "[hal][modbus]") {
  Bench bench;
  REQUIRE(bench.drive.connect());
  WHEN("the motor turns backwards") {
    REQUIRE(bench.drive.set_speed(-605));
    bench.wait_s(0.9);
    bench.model.set_measured(-589.4, 3.21);
    const auto status = bench.drive.read();
    REQUIRE(status);
    THEN("the speed read is the measured one, never an echo of the command") {
      CHECK(status.value().speed_rpm == Approx(-589.4).margin(0.051));
      CHECK(status.value().current_A == Approx(3.21).margin(0.0051));
      CHECK(status.value().output_frequency_Hz == Approx(-18).margin(0.025));
    }
  }
  WHEN("a trip is read") {
    bench.model.trip(sim::fault_overcurrent);
    const auto status = bench.drive.read();
    REQUIRE(status);
    THEN("it is told with the drive's own number") {
      CHECK(status.value().tripped);
      CHECK(status.value().fault_code == 2);
      CHECK_FALSE(status.value().running);
    }
  }
}

TEST_CASE("the drive's own watchdog is read back as it is set", "[hal][modbus]") {
  const auto watchdog_of = [](double timeout_s, sim::CommLossAction action) {
    Bench bench({.comm_loss_timeout_s = timeout_s, .comm_loss_action = action});
    REQUIRE(bench.drive.connect());
    const auto watchdog = bench.drive.read_watchdog();
    REQUIRE(watchdog);
    return watchdog.value();
  };
  CHECK(watchdog_of(0.5, sim::CommLossAction::ramp_to_stop).timeout_s == Approx(0.5));
  CHECK(watchdog_of(0.5, sim::CommLossAction::ramp_to_stop).stops_motor);
  CHECK(watchdog_of(2.0, sim::CommLossAction::coast).timeout_s == Approx(2));
  CHECK(watchdog_of(2.0, sim::CommLossAction::coast).stops_motor);
  CHECK_FALSE(watchdog_of(0.5, sim::CommLossAction::ignore).stops_motor);
  CHECK(watchdog_of(0, sim::CommLossAction::ramp_to_stop).timeout_s == 0);
  CHECK_FALSE(watchdog_of(0, sim::CommLossAction::ramp_to_stop).stops_motor);
}

SCENARIO("connect leaves the drive at rest", "[hal][modbus]") {
  GIVEN("a drive that was left running, by a program that died") {
    Bench bench;
    bench.model.command(sim::RunCommand::forward, 30);
    bench.wait_s(0.1);
    REQUIRE(bench.drive.connect());
    THEN("it is told to stop") { CHECK(bench.model.state().run == sim::RunCommand::stop); }
  }
  GIVEN("a drive that tripped earlier") {
    Bench bench;
    bench.model.trip(sim::fault_comm_loss);
    REQUIRE(bench.drive.connect());
    THEN("the trip is reset and nothing resumes") {
      CHECK_FALSE(bench.model.state().tripped);
      bench.wait_s(1);
      CHECK_FALSE(bench.model.output_enabled());
    }
  }
}

SCENARIO("connect refuses what is not the drive configured", "[hal][modbus]") {
  GIVEN("a motor with another number of poles than configured") {
    Bench bench({.pole_pairs = 3}, 2);
    const auto connected = bench.drive.connect();
    REQUIRE_FALSE(connected);
    THEN("it is refused, and both numbers are told") {
      CHECK(connected.error().code == IoErrc::bad_reply);
      CHECK_THAT(describe(connected.error()), Catch::Contains("3 pole pairs, configured are 2"));
    }
  }
  GIVEN("nobody at that address") {
    Bench bench;
    bench.server.reset();
    const auto connected = bench.drive.connect();
    REQUIRE_FALSE(connected);
    CHECK(connected.error().code == IoErrc::disconnected);
  }
  GIVEN("a drive with another unit id") {
    Bench bench;
    sim::InverterServer other(bench.model, 7);
    hal::ModbusInverter drive({.profile = hal::drive_profile("rvbench_generic"),
                               .path = hal::ModbusTcp{"127.0.0.1", other.port()},
                               .response_timeout_s = response_timeout_s},
                              bench.clock);
    const auto connected = drive.connect();
    REQUIRE_FALSE(connected);
    CHECK(connected.error().code == IoErrc::timeout);
  }
}

SCENARIO("a tripped drive says no, and needs a new connect", "[hal][modbus]") {
  Bench bench;
  REQUIRE(bench.drive.connect());
  bench.model.trip(sim::fault_overcurrent);
  const auto set = bench.drive.set_speed(300);
  REQUIRE_FALSE(set);
  CHECK(set.error().code == IoErrc::refused);
  CHECK(bench.model.state().run == sim::RunCommand::stop);
  CHECK(bench.drive.retries() == 0);
  REQUIRE(bench.drive.connect());
  CHECK(bench.drive.set_speed(300));
}

TEST_CASE("options that make no sense are the caller's bug", "[hal][modbus]") {
  sim::InverterModel model;
  test::InverterClock clock(model);
  const auto make = [&](hal::ModbusInverterOptions options) {
    options.profile = hal::drive_profile("rvbench_generic");
    return std::make_unique<hal::ModbusInverter>(options, clock);
  };
  CHECK_NOTHROW(make({}));
  CHECK_THROWS_AS(make({.path = hal::ModbusTcp{"inverter"}}), std::invalid_argument);
  CHECK_THROWS_AS(make({.path = hal::ModbusTcp{"127.0.0.1", 0}}), std::invalid_argument);
  CHECK_THROWS_AS(make({.response_timeout_s = 0}), std::invalid_argument);
  CHECK_THROWS_AS(make({.limits = {.max_speed_rpm = 3300}}), std::invalid_argument);
  CHECK_THROWS_AS(make({.limits = {.max_speed_rpm = 0}}), std::invalid_argument);
  CHECK_THROWS_AS(make({.path = hal::ModbusRtu{""}}), std::invalid_argument);
  CHECK_THROWS_AS(make({.path = hal::ModbusRtu{"/dev/ttyS0", 300}}), std::invalid_argument);
  CHECK_THROWS_AS(make({.path = hal::ModbusRtu{"/dev/ttyS0", 9600, 'X'}}), std::invalid_argument);
  CHECK_THROWS_AS(make({.motor = {.pole_pairs = 0}}), std::invalid_argument);
  CHECK_THROWS_AS(make({.motor = {.rated_Hz = 0}}), std::invalid_argument);
  CHECK_THROWS_AS(make({.limits = {.max_speed_rpm = 3000}, .motor = {.pole_pairs = 14}}),
                  std::invalid_argument);
}

SCENARIO("a drive that was taken over at its panel is not believed to obey", "[hal][modbus]") {
  Bench bench;
  REQUIRE(bench.drive.connect());
  REQUIRE(bench.drive.read().value().remote);
  bench.model.take_over(sim::RunCommand::forward, 10);
  WHEN("its state is read, and a stop is sent") {
    const auto status = bench.drive.read();
    REQUIRE(status);
    CHECK_FALSE(status.value().remote);
    bench.drive.stop();
    THEN("it runs on as its panel says") { CHECK(bench.model.state().setpoint_Hz == 10); }
  }
  WHEN("one connects to it") {
    const auto connected = bench.drive.connect();
    REQUIRE_FALSE(connected);
    CHECK(connected.error().code == IoErrc::refused);
    CHECK_THAT(connected.error().where, Catch::Contains("obeys its panel"));
  }
}
