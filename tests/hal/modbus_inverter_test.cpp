#include "hal/modbus/modbus_inverter.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>

#include "sim/inverter_model.hpp"
#include "sim/inverter_server.hpp"

using namespace rvbench;
using sim::WireFault;

namespace {

/// Virtual time that moves only the inverter.
class InverterClock final : public hal::Clock {
 public:
  explicit InverterClock(sim::InverterModel& model) : model_(model) {}
  double now_s() const override { return model_.time_s(); }
  void wait_until(double time_s) override {
    while (model_.time_s() < time_s - 1e-9) model_.advance(0.001);
  }
  bool is_virtual() const override { return true; }

 private:
  sim::InverterModel& model_;
};

constexpr double response_timeout_s = 0.1;

struct Bench {
  explicit Bench(const sim::InverterParameters& parameters = {}, int pole_pairs = 2)
      : model(parameters),
        server(std::make_unique<sim::InverterServer>(model)),
        clock(model),
        drive({.port = server->port(),
               .response_timeout_s = response_timeout_s,
               .limits = {.max_speed_rpm = 3000},
               .pole_pairs = pole_pairs},
              clock) {
    server->set_lateness_s(1.3 * response_timeout_s);
  }

  void wait_s(double duration_s) { clock.wait_until(clock.now_s() + duration_s); }

  sim::InverterModel model;
  std::unique_ptr<sim::InverterServer> server;
  InverterClock clock;
  hal::ModbusInverter drive;
};

double real_seconds(const std::function<void()>& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

SCENARIO("driver and drive agree on the register table by what they do", "[hal][modbus]") {
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

SCENARIO("connect identifies the drive and leaves it at rest", "[hal][modbus]") {
  GIVEN("a motor with another number of poles than configured") {
    Bench bench({.pole_pairs = 3}, 2);
    const auto connected = bench.drive.connect();
    REQUIRE_FALSE(connected);
    THEN("it is refused, and both numbers are told") {
      CHECK(connected.error().code == IoErrc::bad_reply);
      CHECK_THAT(describe(connected.error()), Catch::Contains("3 pole pairs, configured are 2"));
    }
  }
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
    hal::ModbusInverter drive({.port = other.port(), .response_timeout_s = response_timeout_s},
                              bench.clock);
    const auto connected = drive.connect();
    REQUIRE_FALSE(connected);
    CHECK(connected.error().code == IoErrc::timeout);
  }
}

SCENARIO("a late reply is never taken for the next one", "[hal][modbus]") {
  Bench bench;
  REQUIRE(bench.drive.connect());
  WHEN("every second reading is answered late, and the value changes before each") {
    int fresh = 0;
    for (int i = 1; i <= 6; ++i) {
      bench.model.set_measured(100 * i, 0);
      if (i % 2 == 0) bench.server->inject({.fault = WireFault::late, .requests = 1});
      const auto status = bench.drive.read();
      if (status && status.value().speed_rpm == 100 * i) ++fresh;
    }
    THEN("each reading has the value of its own time") { CHECK(fresh == 6); }
    THEN("the readings sent again are counted") { CHECK(bench.drive.retries() == 3); }
  }
  WHEN("the confirmation of a setpoint comes late") {
    bench.server->inject({.fault = WireFault::late, .requests = 1});
    const auto set = bench.drive.set_speed(300);
    REQUIRE_FALSE(set);
    THEN("that is a time-out, and the next reading has its own answer") {
      CHECK(set.error().code == IoErrc::timeout);
      bench.model.set_measured(123.4, 5);
      const auto status = bench.drive.read();
      REQUIRE(status);
      CHECK(status.value().speed_rpm == Approx(123.4));
      CHECK(status.value().current_A == Approx(5));
    }
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
  while (bench.server->requests() < 5) std::this_thread::yield();  // connect 3, set 1, read 1
  const double took_s = real_seconds([&] { bench.drive.stop(); });
  reader.join();
  CHECK(bench.model.state().run == sim::RunCommand::stop);
  CHECK(took_s < 4 * response_timeout_s + 0.1);
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
  InverterClock clock(model);
  const auto make = [&](hal::ModbusInverterOptions options) {
    return std::make_unique<hal::ModbusInverter>(options, clock);
  };
  CHECK_NOTHROW(make({}));
  CHECK_THROWS_AS(make({.host = "inverter"}), std::invalid_argument);
  CHECK_THROWS_AS(make({.port = 0}), std::invalid_argument);
  CHECK_THROWS_AS(make({.response_timeout_s = 0}), std::invalid_argument);
  CHECK_THROWS_AS(make({.limits = {.max_speed_rpm = 3300}}), std::invalid_argument);
  CHECK_THROWS_AS(make({.limits = {.max_speed_rpm = 0}}), std::invalid_argument);
  CHECK_THROWS_AS(make({.pole_pairs = 0}), std::invalid_argument);
  CHECK_THROWS_AS(make({.limits = {.max_speed_rpm = 3000}, .pole_pairs = 14}),
                  std::invalid_argument);
}
