#include <catch2/catch.hpp>
#include <functional>
#include <memory>

#include "hal/modbus/modbus_safety_inputs.hpp"
#include "hal/steady_clock.hpp"
#include "sim/modbus_line.hpp"
#include "sim/remote_io_device.hpp"
#include "tests/contracts/safety_inputs_contract.hpp"
#include "tests/support/wait_until.hpp"

using namespace rvbench;
using sim::WireFault;

namespace {

constexpr double response_timeout_s = 0.1;
constexpr hal::SafetyStatus ready{
    .estop_pressed = false, .guard_open = false, .housing_temp_degC = 31};

// The driver against a simulated coupler, over a serial line.
struct SerialCoupler {
  SerialCoupler() { coupler.show(ready); }

  // Waits until a reading is as wanted.
  bool comes(const std::function<bool(const Result<hal::SafetyStatus>&)>& wanted) {
    return test::wait_until([&] { return wanted(inputs.read()); });
  }

  hal::SteadyClock clock;
  sim::RemoteIoDevice coupler;
  sim::ModbusLine line{coupler, 1};
  hal::ModbusSafetyInputs inputs{{.path = hal::ModbusRtu{line.device()},
                                  .response_timeout_s = response_timeout_s,
                                  .period_s = 0.3,
                                  .deadline_s = 2},
                                 clock};
};

}  // namespace

TEST_CASE("safety inputs on a serial line keep the contract", "[hal][contract][modbus][rtu]") {
  SerialCoupler bench;
  test::check_safety_inputs_contract(bench.inputs);
}

SCENARIO("a coupler on a serial line is heard as one on a network", "[hal][modbus][safety][rtu]") {
  SerialCoupler bench;
  REQUIRE(bench.inputs.connect());
  CHECK(bench.inputs.read().value().housing_temp_degC == Approx(31));
  WHEN("the emergency stop is pressed") {
    bench.coupler.show({.estop_pressed = true, .guard_open = false, .housing_temp_degC = 31});
    CHECK(bench.comes([](const auto& read) { return read && read.value().estop_pressed; }));
    CHECK_FALSE(bench.inputs.read().value().guard_open);
  }
  WHEN("it does not answer, or answers nonsense") {
    bench.line.inject({.fault = GENERATE(WireFault::silent, WireFault::garbled)});
    CHECK(bench.comes([](const auto& read) { return !read; }));
    CHECK(bench.inputs.read().error().code == IoErrc::timeout);
    THEN("it is heard again when it does") {
      bench.line.inject({});
      CHECK(bench.comes([](const auto& read) { return bool(read); }));
    }
  }
}

SCENARIO("an answer on a serial line is never taken for a later one",
         "[hal][modbus][safety][rtu]") {
  SerialCoupler bench;
  bench.line.set_lateness_s(GENERATE(1.3, 2.5, 3.5) * response_timeout_s);
  bench.line.set_forgets(GENERATE(false, true));
  REQUIRE(bench.inputs.connect());
  // Two questions make a round, and then there is time: the next one is that for the contacts.
  const int asked = bench.line.requests();
  REQUIRE(test::wait_until(
      [&] { return bench.line.requests() > asked + 1 && bench.line.requests() % 2 == 0; }));
  WHEN("the emergency stop is pressed while the answer to the last question is late") {
    bench.line.inject({.fault = WireFault::late, .requests = 1});
    REQUIRE(test::wait_until([&] { return bench.line.misbehaved() == 1; }));
    bench.coupler.show({.estop_pressed = true, .guard_open = false, .housing_temp_degC = 50});
    THEN("who reads that it is warmer reads that it is pressed, too") {
      Result<hal::SafetyStatus> warmer = ready;
      CHECK(bench.comes([&](const auto& read) {
        warmer = read;
        return read && read.value().housing_temp_degC == Approx(50);
      }));
      CHECK((warmer && warmer.value().estop_pressed));
    }
  }
}
