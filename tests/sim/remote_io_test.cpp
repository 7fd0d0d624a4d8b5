#include <modbus/modbus.h>

#include <array>
#include <catch2/catch.hpp>
#include <cerrno>
#include <memory>
#include <stdexcept>
#include <vector>

#include "sim/remote_io_server.hpp"

using namespace rvbench;

namespace {

// A plain Modbus master that knows nothing of rvbench.
class Master {
 public:
  explicit Master(std::uint16_t port) : context_(modbus_new_tcp("127.0.0.1", port), modbus_free) {
    modbus_set_slave(context_.get(), 1);
    REQUIRE(modbus_connect(context_.get()) == 0);
  }
  ~Master() { modbus_close(context_.get()); }
  Master(const Master&) = delete;
  Master& operator=(const Master&) = delete;

  // Bits, or nothing with the reason in errno.
  std::vector<int> bits(int address, int count) {
    std::vector<std::uint8_t> read(static_cast<std::size_t>(count));
    if (modbus_read_input_bits(context_.get(), address, count, read.data()) != count) return {};
    return {read.begin(), read.end()};
  }
  int temperature() {
    std::uint16_t word = 0;
    REQUIRE(modbus_read_input_registers(context_.get(), 0, 1, &word) == 1);
    return static_cast<std::int16_t>(word);
  }
  bool has_holding_registers() {
    std::uint16_t word = 0;
    return modbus_read_registers(context_.get(), 0, 1, &word) == 1;
  }

 private:
  std::unique_ptr<modbus_t, decltype(&modbus_free)> context_;
};

}  // namespace

SCENARIO("a coupler shows what is wired to it", "[sim][remote_io]") {
  sim::RemoteIoServer coupler;
  Master master(coupler.port());
  THEN("before anything is, the chain is open and the sensor's wire broken") {
    CHECK(master.bits(0, 2) == std::vector{0, 0});
    CHECK(master.temperature() == 8500);
  }
  WHEN("the chain is closed and the housing cold") {
    coupler.show({.estop_pressed = false, .guard_open = false, .housing_temp_degC = -12.34});
    CHECK(master.bits(0, 8) == std::vector{1, 1, 0, 0, 0, 0, 0, 0});
    CHECK(master.temperature() == -123);
  }
  WHEN("one of both is open") {
    coupler.show({.estop_pressed = true, .guard_open = false, .housing_temp_degC = 30});
    CHECK(master.bits(0, 2) == std::vector{0, 1});
    CHECK(master.bits(1, 1) == std::vector{1});
  }
  THEN("it has eight inputs and no holding registers") {
    CHECK(master.bits(7, 2).empty());
    CHECK(errno == EMBXILADD);
    CHECK_FALSE(master.has_holding_registers());
    CHECK(errno == EMBXILFUN);
  }
}

TEST_CASE("a port that is taken is told", "[sim][remote_io]") {
  const sim::RemoteIoServer coupler;
  CHECK_THROWS_AS(sim::RemoteIoServer(coupler.port()), std::runtime_error);
}
