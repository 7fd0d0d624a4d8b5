#include "hal/can/serial_line.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <string>

#include "tests/support/terminal.hpp"

using namespace rvbench;
using std::chrono::milliseconds;

TEST_CASE("a serial line says whether it was silent", "[hal][can]") {
  const test::Terminal adapter;
  hal::SerialLine line;
  REQUIRE(line.open(adapter.name(), 115200));
  CHECK_FALSE(line.wait(milliseconds(1)));
  adapter.type("V1013\r");
  REQUIRE(line.wait(milliseconds(30'000)));
  std::string heard;
  while (heard.size() < 6 && line.wait(milliseconds(30'000))) heard += line.read().value();
  CHECK(heard == "V1013\r");
  CHECK_FALSE(line.wait(milliseconds(1)));
}
