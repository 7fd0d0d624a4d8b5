#include <pthread.h>
#include <signal.h>

#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

#include "hal/modbus/drive_profile_json.hpp"
#include "hal/modbus/modbus_inverter.hpp"
#include "sim/inverter_line.hpp"
#include "tests/hal/modbus_bench.hpp"
#include "tests/support/bare_master.hpp"

using namespace rvbench;
using sim::WireFault;
using test::real_seconds;
using test::response_timeout_s;

namespace {

hal::ModbusInverterOptions over(const sim::InverterLine& line) {
  return {.profile = hal::drive_profile("rvbench_generic"),
          .path = hal::ModbusRtu{line.device()},
          .response_timeout_s = response_timeout_s,
          .limits = {.max_speed_rpm = 3000}};
}

// The driver against a simulated inverter, over a serial line.
struct SerialBench {
  SerialBench() { line.set_lateness_s(1.3 * response_timeout_s); }

  sim::InverterModel model;
  sim::InverterLine line{model};
  test::InverterClock clock{model};
  hal::ModbusInverter drive{over(line), clock};
};

}  // namespace

SCENARIO("a drive on a serial line is driven as one on a network", "[hal][modbus][rtu]") {
  SerialBench bench;
  REQUIRE(bench.drive.connect());
  CHECK(bench.drive.read_watchdog().value().timeout_s == Approx(1));
  REQUIRE(bench.drive.set_speed(605));
  bench.clock.wait_until(bench.clock.now_s() + 0.5);
  bench.model.set_measured(298.5, 2.5);
  const auto status = bench.drive.read();
  REQUIRE(status);
  CHECK(status.value().output_frequency_Hz == Approx(10).margin(0.025));
  CHECK(status.value().speed_rpm == Approx(298.5));
  CHECK(status.value().running);
  bench.drive.stop();
  CHECK(bench.model.state().run == sim::RunCommand::stop);
  CHECK(bench.drive.retries() == 0);
}

TEST_CASE("libmodbus alone hands a late reply on a serial line to the next request",
          "[hal][modbus][rtu]") {
  sim::InverterModel model;
  sim::InverterLine line(model);
  line.set_lateness_s(1.3 * response_timeout_s);
  test::BareMaster master(modbus_new_rtu(line.device().c_str(), 9600, 'N', 8, 1),
                          response_timeout_s);
  std::array<std::uint16_t, 1> speed{};  // of the motor, in 0.1 rpm
  model.set_measured(10, 0);
  line.inject({.fault = WireFault::late, .requests = 1});
  CHECK_FALSE(master.read(0x0203, speed));
  model.set_measured(20, 0);
  REQUIRE(master.read(0x0203, speed));
  CHECK(speed[0] == 100);  // the old value, as if it were the new one
}

SCENARIO("a late reply on a serial line is never taken for the next one", "[hal][modbus][rtu]") {
  SerialBench bench;
  REQUIRE(bench.drive.connect());
  test::check_late_replies(bench.drive, bench.model, bench.line);
}

namespace {

// A drive that has no constants to be known by: who identifies it asks what it is asked anyway.
struct PlainBench {
  sim::InverterModel model;
  sim::InverterLine line{model};
  test::InverterClock clock{model};
  hal::ModbusInverter drive{plain(over(line)), clock};

  static hal::ModbusInverterOptions plain(hal::ModbusInverterOptions options) {
    options.profile.identity.clear();
    options.profile.pole_pairs.reset();
    return options;
  }

  // Reads eight times, the second time with a late reply, and the value changes before each.
  void read_with_one_late() {
    int told = 0;
    for (int i = 1; i <= 8; ++i) {
      model.set_measured(100 * i, 0);
      if (i == 2) line.inject({.fault = WireFault::late, .requests = 1});
      const auto status = drive.read();
      told += status ? 1 : 0;
      CHECK((!status || status.value().speed_rpm == 100 * i));
    }
    CHECK(told >= 6);
  }
};

// Meets the thread that made it with a signal every millisecond.
class Signals {
 public:
  Signals() {
    struct sigaction action {};
    action.sa_handler = [](int) {};
    ::sigaction(SIGUSR1, &action, &before_);
    sender_ = std::jthread([target = ::pthread_self()](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        ::pthread_kill(target, SIGUSR1);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    });
  }
  ~Signals() {
    sender_ = {};
    ::sigaction(SIGUSR1, &before_, nullptr);
  }
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

 private:
  struct sigaction before_ {};
  std::jthread sender_;
};

}  // namespace

SCENARIO("a reply on a serial line is taken for no other, however late it is",
         "[hal][modbus][rtu]") {
  PlainBench bench;
  REQUIRE(bench.drive.connect());
  WHEN("it comes when it was given up, or when the next question was asked") {
    bench.line.set_lateness_s(GENERATE(1.3, 2.5, 3.5, 4.5) * response_timeout_s);
    bench.read_with_one_late();
  }
  WHEN("signals come while it is waited for") {
    bench.line.set_lateness_s(1.3 * response_timeout_s);
    const Signals signals;
    bench.read_with_one_late();
  }
}

SCENARIO("a serial line that is silent or noisy is an error in time", "[hal][modbus][rtu]") {
  SerialBench bench;
  REQUIRE(bench.drive.connect());
  const double limit_s = 7 * response_timeout_s + 0.1;
  WHEN("the cable is pulled") {
    bench.line.inject({.fault = WireFault::silent});
    const double took_s = real_seconds([&] {
      const auto status = bench.drive.read();
      REQUIRE_FALSE(status);
      CHECK(status.error().code == IoErrc::timeout);
    });
    CHECK(took_s < limit_s);
    THEN("a stop after it is back arrives") {
      bench.model.command(sim::RunCommand::forward, 20);
      bench.line.inject({});
      bench.drive.stop();
      CHECK(bench.model.state().run == sim::RunCommand::stop);
    }
  }
  WHEN("replies have bad checksums") {
    bench.line.inject({.fault = WireFault::garbled});
    const auto status = bench.drive.read();
    REQUIRE_FALSE(status);
    CHECK(status.error().code == IoErrc::bad_reply);
    bench.line.inject({});
    CHECK(bench.drive.read());
  }
}

TEST_CASE("silence is kept between a reply and the next request, where a drive needs it",
          "[hal][modbus][rtu]") {
  SerialBench bench;
  auto options = over(bench.line);
  options.profile.turnaround_s = 0.02;
  hal::ModbusInverter slow(options, bench.clock);
  REQUIRE(slow.connect());
  const double took_s = real_seconds([&] {
    for (int i = 0; i < 10; ++i) REQUIRE(slow.read());
  });
  CHECK(took_s >= 10 * 0.02);
}

TEST_CASE("what is not on a profile's list is never written", "[hal][modbus]") {
  sim::InverterModel model;
  sim::InverterLine line(model);
  hal::ModbusLink link({.path = hal::ModbusRtu{line.device()}, .writable = {0x0100, 0x0101}});
  REQUIRE(link.open());
  CHECK(link.write_one("set", 0x0101, 100));
  CHECK_THROWS_AS(link.write_one("set", 0x0002, 0), std::invalid_argument);
  const std::array<std::uint16_t, 3> words{};
  CHECK_THROWS_AS(link.write("set", 0x0100, words), std::invalid_argument);
  CHECK(line.requests() == 1);
}

TEST_CASE("a serial device that is not there is told", "[hal][modbus][rtu]") {
  sim::InverterModel model;
  test::InverterClock clock(model);
  hal::ModbusInverter drive({.profile = hal::drive_profile("rvbench_generic"),
                             .path = hal::ModbusRtu{"/dev/no_such_line"}},
                            clock);
  const auto connected = drive.connect();
  REQUIRE_FALSE(connected);
  CHECK(connected.error().code == IoErrc::disconnected);
  CHECK_THAT(connected.error().where, Catch::Contains("/dev/no_such_line"));
  CHECK_THAT(connected.error().where, Catch::Contains("No such file"));
}
