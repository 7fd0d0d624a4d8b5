#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <functional>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "hal/modbus/modbus_safety_inputs.hpp"
#include "hal/steady_clock.hpp"
#include "sim/remote_io_server.hpp"
#include "tests/contracts/safety_inputs_contract.hpp"
#include "tests/hal/modbus_bench.hpp"
#include "tests/support/wait_until.hpp"

using namespace rvbench;
using sim::WireFault;
using test::real_seconds;

namespace {

const hal::SafetyStatus ready{.estop_pressed = false, .guard_open = false, .housing_temp_degC = 31};

// The driver against a simulated coupler, over a real socket.
struct CouplerBench {
  explicit CouplerBench(hal::ModbusSafetyOptions options = {}) : options_(options) {
    coupler.show(ready);
    options_.path = hal::ModbusTcp{"127.0.0.1", coupler.port()};
    inputs = std::make_unique<hal::ModbusSafetyInputs>(options_, clock);
  }

  // Waits until a reading is as wanted.
  bool comes(const std::function<bool(const Result<hal::SafetyStatus>&)>& wanted) {
    return test::wait_until([&] { return wanted(inputs->read()); });
  }

  hal::SteadyClock clock;
  sim::RemoteIoServer coupler;
  std::unique_ptr<hal::ModbusSafetyInputs> inputs;

 private:
  hal::ModbusSafetyOptions options_;
};

}  // namespace

TEST_CASE("safety inputs on a Modbus coupler keep the contract", "[hal][contract][modbus]") {
  CouplerBench bench;
  test::check_safety_inputs_contract(*bench.inputs);
}

SCENARIO("a coupler's inputs are the safety chain as it is now", "[hal][modbus][safety]") {
  CouplerBench bench;
  REQUIRE(bench.inputs->connect());
  CHECK(bench.inputs->read().value().housing_temp_degC == Approx(31));
  WHEN("the emergency stop is pressed") {
    hal::SafetyStatus status = ready;
    status.estop_pressed = true;
    bench.coupler.show(status);
    CHECK(bench.comes([](const auto& read) { return read && read.value().estop_pressed; }));
    CHECK_FALSE(bench.inputs->read().value().guard_open);
    THEN("once it is released, nobody remembers it") {
      bench.coupler.show(ready);
      CHECK(bench.comes([](const auto& read) { return read && !read.value().estop_pressed; }));
    }
  }
  WHEN("the guard is opened, and it freezes") {
    bench.coupler.show({.estop_pressed = false, .guard_open = true, .housing_temp_degC = -7.3});
    CHECK(bench.comes([](const auto& read) { return read && read.value().guard_open; }));
    const auto status = bench.inputs->read();
    CHECK_FALSE(status.value().estop_pressed);
    CHECK(status.value().housing_temp_degC == Approx(-7.3));
  }
  WHEN("the wire of the temperature sensor breaks") {
    hal::SafetyStatus status = ready;
    status.housing_temp_degC = not_known;
    bench.coupler.show(status);
    THEN("the temperature is not known, rather than the end of the sensor's range") {
      CHECK(bench.comes(
          [](const auto& read) { return read && std::isnan(read.value().housing_temp_degC); }));
    }
  }
}

TEST_CASE("what a coupler said is as old as the question, however often it is read",
          "[hal][modbus][safety]") {
  CouplerBench bench({.deadline_s = 30});
  const double before_s = bench.clock.now_s();
  REQUIRE(bench.inputs->connect());
  CHECK(bench.inputs->read().value().time_s >= before_s);
  CHECK(bench.inputs->read().value().time_s <= bench.clock.now_s());
  bench.coupler.inject({.fault = WireFault::silent});
  // A question that is on its way now may still be answered, none that comes later.
  const double silent_s = bench.clock.now_s();
  CHECK(test::wait_until([&] { return bench.clock.now_s() > silent_s + 0.3; }));
  const auto held = bench.inputs->read();
  REQUIRE(held);
  CHECK(held.value().time_s <= silent_s);
}

SCENARIO("a coupler that falls silent stalls nobody", "[hal][modbus][safety]") {
  CouplerBench bench;
  REQUIRE(bench.inputs->connect());
  WHEN("it answers no more") {
    bench.coupler.inject({.fault = WireFault::silent});
    std::vector<double> took_s;
    CHECK(bench.comes([&](const auto&) {
      Result<hal::SafetyStatus> status = ready;
      took_s.push_back(real_seconds([&] { status = bench.inputs->read(); }));
      return !status && status.error().code == IoErrc::timeout;
    }));
    // One that asked the wire would take a response time-out, each time.
    std::ranges::nth_element(took_s, took_s.begin() + std::ssize(took_s) / 2);
    CHECK(took_s[took_s.size() / 2] < 0.05);
    THEN("the reading says for how long, and what the link said") {
      // It may have fallen silent between the two questions of a round. The next begins anew.
      Result<hal::SafetyStatus> status = ready;
      CHECK(bench.comes([&](const auto& read) {
        status = read;
        return !read && read.error().where.find("read temperature") == std::string::npos;
      }));
      REQUIRE_FALSE(status);
      CHECK_THAT(status.error().where, Catch::Contains("safety inputs 127.0.0.1:") &&
                                           Catch::Contains("no answer for ") &&
                                           Catch::Contains("read contacts"));
    }
    THEN("when it answers again, it is heard again") {
      bench.coupler.inject({});
      CHECK(bench.comes([](const auto& read) { return bool(read); }));
    }
  }
  WHEN("it closes every connection") {
    bench.coupler.inject({.fault = WireFault::dead});
    CHECK(bench.comes([](const auto& read) { return !read; }));
    bench.coupler.inject({});
    CHECK(bench.comes([](const auto& read) { return bool(read); }));
  }
  WHEN("it answers nonsense") {
    bench.coupler.inject({.fault = WireFault::garbled});
    CHECK(bench.comes([](const auto& read) { return !read; }));
  }
  WHEN("one answer is lost") {
    bench.coupler.inject({.fault = WireFault::silent, .requests = 1});
    const int before = bench.coupler.requests();
    bool lost = false;
    CHECK(bench.comes([&](const auto& read) {
      lost = lost || !read;
      return bench.coupler.requests() > before + 4;
    }));
    THEN("the deadline covers it") { CHECK_FALSE(lost); }
  }
}

TEST_CASE("a late answer of a coupler is never taken for the next one", "[hal][modbus][safety]") {
  CouplerBench bench({.deadline_s = 1.5});
  REQUIRE(bench.inputs->connect());
  hal::SafetyStatus status = ready;
  status.estop_pressed = true;
  bench.coupler.show(status);
  CHECK(bench.comes([](const auto& read) { return read && read.value().estop_pressed; }));
  // From here on the chain is closed: an answer that says "pressed" is an old one.
  bench.coupler.inject({.fault = WireFault::late, .requests = 2});
  bench.coupler.show(ready);
  CHECK(bench.comes([](const auto& read) { return read && !read.value().estop_pressed; }));
  bool pressed = false;
  const int before = bench.coupler.requests();
  CHECK(bench.comes([&](const auto& read) {
    pressed = pressed || (read && read.value().estop_pressed);
    return bench.coupler.requests() > before + 20;
  }));
  CHECK_FALSE(pressed);
}

TEST_CASE("a coupler that nobody asks any more, for want of memory, is a lost one",
          "[hal][modbus][safety]") {
  // Throws where it is asked for the time by any thread but this one.
  class ScarceClock final : public hal::Clock {
   public:
    double now_s() const override {
      if (is_scarce && std::this_thread::get_id() != owner_) throw std::bad_alloc();
      return clock_.now_s();
    }
    void wait_until(double time_s) override { clock_.wait_until(time_s); }
    bool is_virtual() const override { return false; }

    std::atomic<bool> is_scarce = false;

   private:
    hal::SteadyClock clock_;
    std::thread::id owner_ = std::this_thread::get_id();
  };
  ScarceClock clock;
  sim::RemoteIoServer coupler;
  hal::ModbusSafetyInputs inputs({.path = hal::ModbusTcp{"127.0.0.1", coupler.port()}}, clock);
  REQUIRE(inputs.connect());
  clock.is_scarce = true;
  Result<hal::SafetyStatus> read = ready;
  CHECK(test::wait_until([&] {
    read = inputs.read();
    return !read && read.error().code == IoErrc::disconnected;
  }));
  REQUIRE_FALSE(read);
  CHECK_THAT(read.error().where,
             Catch::Contains("safety inputs 127.0.0.1:") && Catch::Contains("std::bad_alloc"));
  clock.is_scarce = false;
  REQUIRE(inputs.connect());
  CHECK(inputs.read());
}

TEST_CASE("a contact may be wired the other way round", "[hal][modbus][safety]") {
  CouplerBench bench({.estop = {.address = 5, .closed = false}, .guard = {.address = 1}});
  REQUIRE(bench.inputs->connect());
  CHECK_FALSE(bench.inputs->read().value().estop_pressed);  // not wired: 0
  CouplerBench straight({.estop = {.address = 5}, .guard = {.address = 1}});
  REQUIRE(straight.inputs->connect());
  CHECK(straight.inputs->read().value().estop_pressed);
}

TEST_CASE("registers that a coupler does not have are refused at connect", "[hal][modbus]") {
  CouplerBench holding({.temperature = {.is_holding = true}});
  const auto connected = holding.inputs->connect();
  REQUIRE_FALSE(connected);
  CHECK(connected.error().code == IoErrc::refused);
  CHECK_THAT(connected.error().where, Catch::Contains("read temperature"));
  CouplerBench beyond({.guard = {.address = 8}});
  CHECK_FALSE(beyond.inputs->connect());
  CHECK_FALSE(beyond.inputs->read());
}

TEST_CASE("a coupler that is not there is told", "[hal][modbus]") {
  hal::SteadyClock clock;
  std::uint16_t port = 0;
  { port = sim::RemoteIoServer().port(); }
  hal::ModbusSafetyInputs inputs({.path = hal::ModbusTcp{"127.0.0.1", port}}, clock);
  const auto connected = inputs.connect();
  REQUIRE_FALSE(connected);
  CHECK(connected.error().code == IoErrc::disconnected);
}

TEST_CASE("safety options that make no sense are the caller's bug", "[hal][modbus]") {
  hal::SteadyClock clock;
  using Options = hal::ModbusSafetyOptions;
  for (const Options& options : {Options{.estop = {.address = 3}, .guard = {.address = 3}},
                                 Options{.estop = {.address = 0}, .guard = {.address = 2000}},
                                 Options{.temperature = {.scale_degC = 0}},
                                 Options{.temperature = {.min_degC = 50, .max_degC = 50}},
                                 Options{.period_s = 0}, Options{.deadline_s = -1}}) {
    CHECK_THROWS_AS(hal::ModbusSafetyInputs(options, clock), std::invalid_argument);
  }
}
