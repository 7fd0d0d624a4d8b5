#include "sim/inverter_server.hpp"

#include <modbus/modbus.h>

#include <array>
#include <catch2/catch.hpp>
#include <cerrno>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "sim/inverter_model.hpp"

using namespace rvbench;

namespace {

// A plain Modbus master that knows nothing of rvbench.
class Master {
 public:
  explicit Master(std::uint16_t port) : context_(modbus_new_tcp("127.0.0.1", port)) {
    modbus_set_slave(context_, 1);
    modbus_set_response_timeout(context_, 1, 0);
    REQUIRE(modbus_connect(context_) == 0);
  }
  ~Master() {
    modbus_close(context_);
    modbus_free(context_);
  }
  Master(const Master&) = delete;
  Master& operator=(const Master&) = delete;

  std::vector<int> read(int address, int count) {
    std::vector<std::uint16_t> words(static_cast<std::size_t>(count));
    if (modbus_read_registers(context_, address, count, words.data()) < 0) return {};
    return {words.begin(), words.end()};
  }
  bool write(int address, std::vector<std::uint16_t> words) {
    return modbus_write_registers(context_, address, static_cast<int>(words.size()),
                                  words.data()) >= 0;
  }
  bool write_one(int address, std::uint16_t word) {
    return modbus_write_register(context_, address, word) >= 0;
  }
  bool read_coil() {
    std::uint8_t bit = 0;
    return modbus_read_bits(context_, 0, 1, &bit) >= 0;
  }

 private:
  modbus_t* context_;
};

void advance(sim::InverterModel& model, double duration_s) {
  for (int i = 0; i < std::lround(1000 * duration_s); ++i) model.advance(0.001);
}

}  // namespace

SCENARIO("the drive ramps, reverses through standstill and stops", "[sim][inverter]") {
  sim::InverterModel model(
      {.ramp_up_Hz_per_s = 20, .ramp_down_Hz_per_s = 40, .comm_loss_timeout_s = 0});
  CHECK_FALSE(model.output_enabled());
  REQUIRE(model.command(sim::RunCommand::forward, 30));
  advance(model, 1);
  CHECK(model.output_frequency_Hz() == Approx(20));
  advance(model, 2);
  CHECK(model.output_frequency_Hz() == Approx(30));
  WHEN("it is reversed") {
    REQUIRE(model.command(sim::RunCommand::reverse, 30));
    THEN("it slows down at 40 Hz/s and speeds up at 20 Hz/s") {
      advance(model, 0.5);
      CHECK(model.output_frequency_Hz() == Approx(10));
      advance(model, 0.25 + 0.5);
      CHECK(model.output_frequency_Hz() == Approx(-10).margin(0.05));
    }
  }
  WHEN("it is stopped") {
    REQUIRE(model.command(sim::RunCommand::stop, 0));
    advance(model, 0.5);
    CHECK(model.output_enabled());
    advance(model, 0.3);
    THEN("the output is off at standstill") {
      CHECK(model.output_frequency_Hz() == 0);
      CHECK_FALSE(model.output_enabled());
    }
  }
}

SCENARIO("a tripped drive coasts, refuses runs, and is reset by an edge at stop only",
         "[sim][inverter]") {
  sim::InverterModel model({.comm_loss_timeout_s = 0});
  REQUIRE(model.command(sim::RunCommand::forward, 30));
  advance(model, 1);
  model.trip(sim::fault_overcurrent);
  CHECK_FALSE(model.output_enabled());
  CHECK_FALSE(model.command(sim::RunCommand::forward, 30));
  model.set_reset(true);
  CHECK_FALSE(model.state().tripped);
  model.trip(sim::fault_overcurrent);
  model.set_reset(true);  // still high: no edge
  CHECK(model.state().tripped);
  model.set_reset(false);
  model.set_reset(true);
  CHECK_FALSE(model.state().tripped);
  advance(model, 1);
  CHECK_FALSE(model.output_enabled());
}

SCENARIO("the drive's watchdog runs out in virtual time", "[sim][inverter]") {
  const auto action = GENERATE(sim::CommLossAction::ramp_to_stop, sim::CommLossAction::coast,
                               sim::CommLossAction::ignore);
  sim::InverterModel model(
      {.ramp_down_Hz_per_s = 20, .comm_loss_timeout_s = 1, .comm_loss_action = action});
  advance(model, 5);  // at rest nobody needs to talk to it
  CHECK_FALSE(model.state().tripped);
  model.note_request();
  REQUIRE(model.command(sim::RunCommand::forward, 10));
  advance(model, 0.9);
  model.note_request();
  advance(model, 0.99);
  CHECK_FALSE(model.state().tripped);
  CHECK(model.output_frequency_Hz() == Approx(10));
  advance(model, 0.02);
  const sim::InverterState state = model.state();
  if (action == sim::CommLossAction::ignore) {
    CHECK_FALSE(state.tripped);
    CHECK(state.output_frequency_Hz == Approx(10));
    return;
  }
  CHECK(state.tripped);
  CHECK(state.fault_code == sim::fault_comm_loss);
  CHECK(state.run == sim::RunCommand::stop);
  CHECK(state.output_enabled == (action == sim::CommLossAction::ramp_to_stop));
  advance(model, 0.6);
  CHECK(model.output_frequency_Hz() == 0);
  CHECK_FALSE(model.output_enabled());
}

SCENARIO("a plain Modbus master finds the registers where the manual has them", "[sim][inverter]") {
  sim::InverterModel model({.pole_pairs = 3, .comm_loss_timeout_s = 0.5});
  sim::InverterServer server(model);
  Master master(server.port());
  CHECK(master.read(0x0000, 4) == std::vector<int>{0x5242, 3, 5, 1});
  REQUIRE(master.write(0x0100, {2, 1234}));
  CHECK(model.state().run == sim::RunCommand::reverse);
  CHECK(model.state().setpoint_Hz == Approx(12.34));
  CHECK(master.read(0x0100, 2) == std::vector<int>{2, 1234});
  advance(model, 0.3);
  model.set_measured(-120.4, 1.27);
  CHECK(master.read(0x0200, 5) == std::vector<int>{5, 600, 127, 65536 - 1204, 0});
  CHECK(master.read(0x0203, 1) == std::vector<int>{65536 - 1204});
  REQUIRE(master.write_one(0x0100, 0));
  CHECK(model.state().run == sim::RunCommand::stop);
  CHECK(server.requests() == 6);
}

SCENARIO("requests that make no sense are answered with the right exception", "[sim][inverter]") {
  sim::InverterModel model({.max_frequency_Hz = 100});
  sim::InverterServer server(model);
  Master master(server.port());
  const auto refused_with = [&](bool accepted, int error) { return !accepted && errno == error; };
  CHECK(refused_with(!master.read(0x0000, 5).empty(), EMBXILADD));
  CHECK(refused_with(!master.read(0x0300, 1).empty(), EMBXILADD));
  CHECK(refused_with(master.write_one(0x0002, 0), EMBXILADD));  // the watchdog is not ours to set
  CHECK(refused_with(master.write(0x0101, {1000, 0}), EMBXILADD));
  CHECK(refused_with(master.write(0x0100, {3, 1000}), EMBXILVAL));
  CHECK(refused_with(master.write(0x0100, {0x81, 1000}), EMBXILVAL));
  CHECK(refused_with(master.write(0x0100, {1, 10001}), EMBXILVAL));
  CHECK(refused_with(master.write_one(0x0100, 0x0400), EMBXILVAL));
  CHECK(refused_with(master.read_coil(), EMBXILFUN));
  model.trip(sim::fault_overcurrent);
  CHECK(refused_with(master.write(0x0100, {1, 1000}), EMBXSFAIL));
  CHECK(model.state().run == sim::RunCommand::stop);
  CHECK(master.read(0x0200, 5) == std::vector<int>{2, 0, 0, 0, 2});
  CHECK(master.write_one(0x0100, 0x80));
  CHECK(master.read(0x0200, 1) == std::vector<int>{0});
}

SCENARIO("a planned fault holds after its requests, for its count", "[sim][inverter]") {
  sim::InverterModel model;
  sim::InverterServer server(model);
  Master master(server.port());
  const auto is_busy = [&] { return master.read(0x0000, 1).empty(); };
  CHECK_FALSE(is_busy());
  server.inject({.fault = sim::WireFault::busy, .after_requests = 2, .requests = 1});
  CHECK_FALSE(is_busy());
  CHECK_FALSE(is_busy());
  CHECK(is_busy());
  CHECK_FALSE(is_busy());
}

SCENARIO("a silent drive does nothing, a garbled one does it and answers nonsense",
         "[sim][inverter]") {
  sim::InverterModel model;
  sim::InverterServer server(model);
  Master master(server.port());
  WHEN("it is silent") {
    server.inject({.fault = sim::WireFault::silent});
    CHECK_FALSE(master.write(0x0100, {1, 1000}));
    CHECK(errno == ETIMEDOUT);
    CHECK(model.state().run == sim::RunCommand::stop);
  }
  WHEN("it is garbled") {
    server.inject({.fault = sim::WireFault::garbled});
    CHECK_FALSE(master.write(0x0100, {1, 1000}));
    CHECK(errno != ETIMEDOUT);
    CHECK(model.state().run == sim::RunCommand::forward);
  }
  WHEN("it is dead") {
    server.inject({.fault = sim::WireFault::dead});
    CHECK_FALSE(master.write(0x0100, {1, 1000}));
    CHECK(errno == ECONNRESET);
  }
}

TEST_CASE("servers live side by side, each on a port of its own", "[sim][inverter]") {
  sim::InverterModel model;
  sim::InverterServer one(model);
  sim::InverterServer two(model);
  CHECK(one.port() != 0);
  CHECK(one.port() != two.port());
}

TEST_CASE("an inverter with parameters that make no sense is the caller's bug", "[sim][inverter]") {
  CHECK_THROWS_AS(sim::InverterModel({.pole_pairs = 0}), std::invalid_argument);
  CHECK_THROWS_AS(sim::InverterModel({.max_frequency_Hz = -1}), std::invalid_argument);
  CHECK_THROWS_AS(sim::InverterModel({.ramp_up_Hz_per_s = 0}), std::invalid_argument);
  CHECK_THROWS_AS(sim::InverterModel({.comm_loss_timeout_s = -1}), std::invalid_argument);
  sim::InverterModel model;
  CHECK_THROWS_AS(model.advance(-0.1), std::invalid_argument);
}
