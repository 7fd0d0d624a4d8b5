#include "hal/can/slcan_frames.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>
#include <vector>

using namespace rvbench;
using namespace hal::slcan_frames;

namespace {

std::vector<LineKind> kinds_in(LineReader& reader) {
  std::vector<LineKind> kinds;
  while (const auto line = reader.next()) kinds.push_back(line->kind);
  return kinds;
}

}  // namespace

TEST_CASE("a frame is read from a serial adapter's line", "[hal][can]") {
  // The manual's example, a frame without data, small letters, and one with a time stamp.
  for (const char* text : {"t1232AABB", "t1232aabb", "t1232AABB0A3F"}) {
    INFO(text);
    const Line line = line_from(text);
    REQUIRE(line.kind == LineKind::frame);
    CHECK(line.frame.id == 0x123);
    CHECK(line.frame.length == 2);
    CHECK(line.frame.data == std::array<std::uint8_t, 8>{0xAA, 0xBB});
  }
  CHECK(line_from("t7FF0").frame.id == 0x7FF);
  const Line full = line_from("t18180123456789ABCDEF");
  CHECK(full.frame.length == 8);
  CHECK(full.frame.data ==
        std::array<std::uint8_t, 8>{1, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF});
}

TEST_CASE("each answer of a serial adapter is known", "[hal][can]") {
  CHECK(line_from("").kind == LineKind::done);
  CHECK(line_from("z").kind == LineKind::sent);
  CHECK(line_from("Z").kind == LineKind::sent);
  CHECK(line_from("V1013").kind == LineKind::version);
  CHECK(line_from("NA123").kind == LineKind::version);
  for (const char* other : {"T000001231AA", "r1230", "r1238", "R1FFFFFFF0", "T1FFFFFFF0BEEF"}) {
    INFO(other);
    CHECK(line_from(other).kind == LineKind::other_frame);
  }
  CHECK(line_from("F00").kind == LineKind::flags);
  CHECK(line_from("F8c").flags == (bus_error | data_overrun | error_warning));
  CHECK(line_from("sa000000").flags == 0);
  CHECK(line_from("sw100096").flags == error_warning);
  CHECK(line_from("sp130000").flags == error_passive);
  CHECK(line_from("sb000256").flags == bus_off);
  CHECK(line_from("e1a").flags == bus_error);
  CHECK(line_from("e3coO").flags == (bus_error | data_overrun | send_queue_full));
  CHECK(line_from("e1a").kind == LineKind::remark);
}

TEST_CASE("what is no line of the protocol is garbled", "[hal][can]") {
  for (const std::string text :
       {"t",         "t123",     "t1239",    "t8000", "t1232AAB", "t1232AABBC", "t1232AABB0A3F0",
        "t1232AAXX", "t12 0",    "t-120",    "t123/", "T1230",    "T200000000", "r800",
        "r12300",    "zz",       "z1",       "F",     "F0",       "F000",       "FGG",
        "s",         "sx000000", "sb00025x", "sb256", "e",        "e0",         "e1",
        "e1x",       "e2a",      "e9",       "q",     "V\x01",    "\xFF",       "1"}) {
    INFO(text);
    CHECK(line_from(text).kind == LineKind::garbled);
  }
  CHECK(line_from("t1239001122334455667788").kind == LineKind::garbled);  // nine bytes
}

SCENARIO("lines are cut out of bytes that come in pieces", "[hal][can]") {
  const std::string bytes = "z\rt1232AABB\r\a\rF04\rxx\a";
  const std::vector whole{LineKind::sent,  LineKind::frame,   LineKind::declined, LineKind::done,
                          LineKind::flags, LineKind::garbled, LineKind::declined};
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
    INFO("cut at " << cut);
    LineReader reader;
    reader.add(bytes.substr(0, cut));
    auto kinds = kinds_in(reader);
    reader.add(bytes.substr(cut));
    for (const LineKind kind : kinds_in(reader)) kinds.push_back(kind);
    CHECK(kinds == whole);
  }
  GIVEN("a line that does not end") {
    LineReader reader;
    for (int i = 0; i < 1000; ++i) {
      reader.add("0123456789");
      CHECK_FALSE(reader.next());
    }
    THEN("it is garbled once, and the next one is read") {
      reader.add("\rz\r");
      CHECK(kinds_in(reader) == std::vector{LineKind::garbled, LineKind::sent});
    }
  }
}

TEST_CASE("a frame becomes the command that sends it", "[hal][can]") {
  CHECK(command_from({.id = 0x201, .length = 4, .data = {0x0A, 0x00, 0x01, 0xFF}}) ==
        "t20140A0001FF\r");
  CHECK(command_from({.id = 1}) == "t0010\r");
  CHECK_THROWS_AS(command_from({.id = 0x800}), std::invalid_argument);
  CHECK_THROWS_AS(command_from({.id = 1, .length = 9}), std::invalid_argument);
}

TEST_CASE("nine bit rates have a command", "[hal][can]") {
  CHECK(command_from_bitrate(10) == "S0\r");
  CHECK(command_from_bitrate(250) == "S5\r");
  CHECK(command_from_bitrate(500) == "S6\r");
  CHECK(command_from_bitrate(1000) == "S8\r");
  CHECK_FALSE(command_from_bitrate(200));
}
