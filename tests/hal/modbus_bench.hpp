#pragma once

#include <catch2/catch.hpp>
#include <chrono>
#include <functional>
#include <memory>

#include "hal/modbus/drive_profile_json.hpp"
#include "hal/modbus/modbus_inverter.hpp"
#include "sim/inverter_model.hpp"
#include "sim/inverter_server.hpp"

namespace rvbench::test {

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

inline constexpr double response_timeout_s = 0.1;

/// The driver against a simulated inverter, over a real socket.
struct ModbusBench {
  explicit ModbusBench(const sim::InverterParameters& parameters = {}, int pole_pairs = 2)
      : model(parameters),
        server(std::make_unique<sim::InverterServer>(model)),
        clock(model),
        drive({.profile = hal::drive_profile("rvbench_generic"),
               .path = hal::ModbusTcp{"127.0.0.1", server->port()},
               .response_timeout_s = response_timeout_s,
               .limits = {.max_speed_rpm = 3000},
               .motor = {.pole_pairs = pole_pairs}},
              clock) {
    server->set_lateness_s(1.3 * response_timeout_s);
  }

  void wait_s(double duration_s) { clock.wait_until(clock.now_s() + duration_s); }

  sim::InverterModel model;
  std::unique_ptr<sim::InverterServer> server;
  InverterClock clock;
  hal::ModbusInverter drive;
};

inline double real_seconds(const std::function<void()>& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A scenario's part that is the same on every wire.
/// @param line  what the simulated inverter answers on
template <typename Line>
void check_late_replies(hal::Drive& drive, sim::InverterModel& model, Line& line) {
  WHEN("every second reading is answered late, and the value changes before each") {
    int fresh = 0;
    for (int i = 1; i <= 6; ++i) {
      model.set_measured(100 * i, 0);
      if (i % 2 == 0) line.inject({.fault = sim::WireFault::late, .requests = 1});
      const auto status = drive.read();
      if (status && status.value().speed_rpm == 100 * i) ++fresh;
    }
    THEN("each reading has the value of its own time") { CHECK(fresh == 6); }
    THEN("the readings sent again are counted") { CHECK(drive.retries() == 3); }
  }
  WHEN("the confirmation of a setpoint comes late") {
    line.inject({.fault = sim::WireFault::late, .requests = 1});
    const auto set = drive.set_speed(300);
    REQUIRE_FALSE(set);
    THEN("that is a time-out, and the next reading has its own answer") {
      CHECK(set.error().code == IoErrc::timeout);
      model.set_measured(123.4, 5);
      const auto status = drive.read();
      REQUIRE(status);
      CHECK(status.value().speed_rpm == Approx(123.4));
      CHECK(status.value().current_A == Approx(5));
    }
  }
}

}  // namespace rvbench::test
