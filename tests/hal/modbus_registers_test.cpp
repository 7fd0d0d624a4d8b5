#include <catch2/catch.hpp>
#include <stdexcept>

#include "hal/modbus/inverter_registers.hpp"

using namespace rvbench::hal;
using namespace rvbench::hal::inverter_registers;

TEST_CASE("a speed becomes a run word and a frequency", "[hal][modbus]") {
  // 1815 rpm = 30.25 rev/s; with 2 pole pairs 60.50 Hz.
  CHECK(words_from_speed(1815, 2) == CommandWords{1, 6050});
  CHECK(words_from_speed(-1815, 2) == CommandWords{2, 6050});
  CHECK(words_from_speed(600, 1) == CommandWords{1, 1000});
  CHECK(words_from_speed(0, 2) == CommandWords{0, 0});
  CHECK(words_from_speed(0.1, 2) == CommandWords{0, 0});  // below the resolution of 0.01 Hz
  CHECK_THROWS_AS(words_from_speed(3276, 13), std::invalid_argument);
}

TEST_CASE("status words become physical values", "[hal][modbus]") {
  const auto status = status_from_words({0x0005, 2017, 321, 0xE8F6, 0});
  REQUIRE(status);
  CHECK(status->output_frequency_Hz == Approx(-20.17));
  CHECK(status->current_A == Approx(3.21));
  CHECK(status->speed_rpm == Approx(-589.8));  // 0xE8F6 = 59638 = -5898 in 16 bits
  CHECK(status->running);
  CHECK_FALSE(status->tripped);
  CHECK(status_from_words({0x0002, 0, 0, 0, 17})->fault_code == 17);
}

TEST_CASE("words that the drive never sends are not believed", "[hal][modbus]") {
  CHECK_FALSE(status_from_words({0x0008, 0, 0, 0, 0}));
  CHECK(settings_from_words({0x5242, 2, 10, 1}));
  CHECK_FALSE(settings_from_words({0x5243, 2, 10, 1}));
  CHECK_FALSE(settings_from_words({0x5242, 0, 10, 1}));
  CHECK_FALSE(settings_from_words({0x5242, 2, 10, 3}));
}
