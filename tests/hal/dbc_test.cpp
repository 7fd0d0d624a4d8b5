#include "hal/can/dbc.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <utility>

#include "tests/hal/dbc_text.hpp"

using namespace rvbench;
using namespace rvbench::hal;

namespace {

// All that there is in a file beside it.
const std::string transducer = std::string(R"(VERSION "1.0"

NS_ :
	NS_DESC_
	CM_
	BO_
	VAL_

BS_:

BU_: Transducer Bench
)") + test::torque_data + R"(
BO_ 2566851328 Status: 8 Transducer
 SG_ Page M : 7|2@0+ (1,0) [0|3] "" Bench
 SG_ Temperature m0 : 15|16@0- (0.1,-40) [-40|200] "degC" Bench
 SG_ Serial m1 : 15|24@0+ (1,0) [0|16777215] "" Bench

CM_ BO_ 385 "one frame per sample
BO_ 999 NotAMessage: 8 X";
CM_ SG_ 385 Torque "at the input shaft";
BA_DEF_ BO_ "GenMsgCycleTime" INT 0 65535;
VAL_ 385 State 0 "sound" 1 "zeroing" 4 "shunt on" ;
)";

dbc::Database read(const std::string& text) {
  auto parsed = dbc::parse(text);
  REQUIRE(test::faults_in(parsed) == "");
  return std::get<0>(std::move(parsed));
}

std::string faults_of(const std::string& text) { return test::faults_in(dbc::parse(text)); }

double value(const dbc::Message& message, const char* signal, const CanFrame& frame) {
  return dbc::value_of(message, *message.find(signal), frame).value();
}

// One signal in eight bytes; each test says where.
double one(const std::string& where, const std::array<std::uint8_t, 8>& data) {
  const dbc::Database database = read("BO_ 1 M: 8 X\n SG_ S : " + where + " (1,0) [0|0] \"\" X\n");
  return value(database.messages.front(), "S", {.id = 1, .length = 8, .data = data});
}

}  // namespace

TEST_CASE("a database names messages, signals, units and words", "[hal][can][dbc]") {
  const dbc::Database database = read(transducer);
  REQUIRE(database.messages.size() == 2);  // the one inside a comment is none
  const dbc::Message& torque = *database.find("TorqueData");
  CHECK(torque.id == 0x181);
  CHECK_FALSE(torque.is_extended);
  CHECK(torque.length == 8);
  CHECK(torque.find("Torque")->unit == "Nm");
  CHECK(dbc::word_for(*torque.find("State"), 4) == "shunt on");
  CHECK(dbc::word_for(*torque.find("State"), 2) == "2");
  CHECK(torque.find("Speed") == nullptr);
  const dbc::Message& status = *database.find("Status");
  CHECK(status.is_extended);
  CHECK(status.id == 0x18FF0B00);
}

TEST_CASE("numbers are taken out of frames in both byte orders", "[hal][can][dbc]") {
  // The lowest byte first: 0x0012D687 = 1234567.
  CHECK(one("0|32@1-", {0x87, 0xD6, 0x12, 0x00}) == 1234567);
  CHECK(one("0|32@1-", {0x79, 0x29, 0xED, 0xFF}) == -1234567);
  CHECK(one("4|8@1+", {0xA0, 0x05}) == 0x5A);  // across a byte's end
  // The highest byte first; the first bit is the highest one of byte 0.
  CHECK(one("7|16@0+", {0x12, 0x34}) == 0x1234);
  CHECK(one("7|16@0-", {0xFF, 0xFE}) == -2);
  CHECK(one("3|8@0+", {0x0A, 0x50}) == 0xA5);
  CHECK(one("0|64@1+", {0, 0, 0, 0, 0, 0, 0, 0x80}) == 9223372036854775808.0);
  CHECK(one("7|64@0-", {0x80, 0, 0, 0, 0, 0, 0, 0}) == -9223372036854775808.0);
  CHECK(one("63|1@1+", {0, 0, 0, 0, 0, 0, 0, 0x80}) == 1);
}

TEST_CASE("a frame of the transducer means what its table says", "[hal][can][dbc]") {
  const dbc::Database database = read(transducer);
  const dbc::Message& torque = *database.find("TorqueData");
  const CanFrame frame{
      .id = 0x181, .length = 8, .data = {0x87, 0xD6, 0x12, 0x00, 0x00, 0x40, 0x05, 0x04}};
  CHECK(value(torque, "Torque", frame) == Approx(1.234567));
  CHECK(value(torque, "Angle", frame) == Approx(90));
  CHECK(value(torque, "Counter", frame) == 5);
  CHECK(value(torque, "State", frame) == 4);
}

TEST_CASE("what a frame does not carry is not read out of it", "[hal][can][dbc]") {
  const dbc::Database database = read(transducer);
  const dbc::Message& status = *database.find("Status");
  const CanFrame page_0{.id = 0x18FF0B00, .length = 8, .data = {0x00, 0x02, 0x9E}};
  const CanFrame page_1{.id = 0x18FF0B00, .length = 8, .data = {0x40, 0x01, 0x02, 0x03}};
  const dbc::Signal& temperature = *status.find("Temperature");
  CHECK(dbc::value_of(status, temperature, page_0).value() == Approx(27));  // 670 * 0.1 - 40
  CHECK_FALSE(dbc::value_of(status, temperature, page_1));
  CHECK(value(status, "Serial", page_1) == 0x010203);
  CanFrame other = page_0;
  other.id = 0x181;
  CHECK_FALSE(dbc::value_of(status, temperature, other));
  CanFrame cut = page_0;
  cut.length = 7;
  CHECK_FALSE(dbc::value_of(status, temperature, cut));
}

TEST_CASE("what nobody reads of a database does not refuse it", "[hal][can][dbc]") {
  const dbc::Database database = read(R"(VERSION ""
BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 Vector__XXX
 SG_ Spare : 0|8@1+ (1,0) [0|0] "" Vector__XXX
 SG_ Spare : 0|64@1- (1,0) [0|0] "" Vector__XXX

BO_ 385 TorqueData: 8 X
 SG_ Torque : 0|32@1- (1,0) [0|0] "Nm" X
 SG_ Power : 32|32@1- (1,0) [0|0] "W" X
VAL_ 385 Nobody 0 "a" ;
VAL_ 999 Torque 0 "a" 1 "b" ;
SIG_VALTYPE_ 385 Power : 1;
SIG_VALTYPE_ 385 Torque : 0;
SIG_VALTYPE_ 385 Nobody : 1;
SIG_VALTYPE_ 999 Torque 2;
SIG_VALTYPE_ 3221225472 Spare : 2;
)");
  REQUIRE(database.messages.size() == 1);
  const dbc::Message& torque = database.messages.front();
  REQUIRE(torque.signals.size() == 2);
  const CanFrame frame{.id = 385, .length = 8, .data = {5, 0, 0, 0, 0, 0, 0x80, 0x3F}};
  CHECK(value(torque, "Torque", frame) == 5);
  CHECK(torque.find("Power")->is_float);
  CHECK_FALSE(dbc::value_of(torque, *torque.find("Power"), frame));
  // A message behind the one that is passed over is none of it.
  CHECK_THAT(faults_of("BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 X\nBO_ 1 M: 9 X\n"),
             Catch::Contains("2: M has 9 bytes"));
}

TEST_CASE("a signal that nothing selects is refused, wherever the selecting one would stand",
          "[hal][can][dbc]") {
  CHECK(faults_of("BO_ 1 A: 8 X\n SG_ Late m0 : 8|8@1+ (1,0) [0|0] \"\" X\n"
                  " SG_ Page M : 0|8@1+ (1,0) [0|0] \"\" X\n") == "");
  const std::string faults = faults_of(R"(BO_ 1 A: 8 X
 SG_ Page M : 0|8@1+ (1,0) [0|0] "" X
BO_ 2 B: 8 X
 SG_ Lost m0 : 8|8@1+ (1,0) [0|0] "" X
 SG_ Plain : 16|8@1+ (1,0) [0|0] "" X
BO_ 3 C: 8 X
 SG_ Page M : 64|8@1+ (1,0) [0|0] "" X
 SG_ Selected m1 : 8|8@1+ (1,0) [0|0] "" X
BO_ 4 D: 8 X
 SG_ Last m2 : 8|8@1+ (1,0) [0|0] "" X
)");
  CHECK_THAT(faults, Catch::Contains("4: Lost: no signal of its message selects it"));
  CHECK_THAT(faults, Catch::Contains("10: Last: no signal of its message selects it"));
  CHECK_THAT(faults, !Catch::Contains("Selected"));  // its fault is another one's
}

TEST_CASE("a byte order is one of two", "[hal][can][dbc]") {
  for (const char* order : {"2", "-1", "10"}) {
    CHECK_THAT(
        faults_of(std::string("BO_ 1 A: 8 X\n SG_ S : 7|8@") + order + "+ (1,0) [0|0] \"\" X\n"),
        Catch::Contains("2: S: the byte order is"));
  }
}

TEST_CASE("a database's faults come all at once, each with its line", "[hal][can][dbc]") {
  CHECK(faults_of(transducer) == "");
  const std::string faults = faults_of(R"(BO_ 385 TorqueData: 9 X
 SG_ Lost : 0|8@1+ (1,0) [0|0] "" X
BO_ 386 Other: 8 X
 SG_ Long : 60|8@1+ (1,0) [0|0] "" X
 SG_ Down : 0|2@0+ (1,0) [0|0] "" X
 SG_ Motorola : 56|2@0+ (1,0) [0|0] "" X
 SG_ Zero : 0|8@1+ (0,0) [0|0] "" X
 SG_ Twice : 0|8@1+ (1,0) [0|0] "" X
 SG_ Twice : 8|8@1+ (1,0) [0|0] "" X
 SG_ Odd : 0|8@1* (1,0) [0|0] "" X
)");
  CHECK_THAT(faults, Catch::Contains("1: TorqueData has 9 bytes"));
  CHECK_THAT(faults, Catch::Contains("2: a signal (SG_) that belongs to no message"));
  CHECK_THAT(faults, Catch::Contains("4: Long: ends outside of its message"));
  CHECK_THAT(faults, !Catch::Contains("5: "));
  CHECK_THAT(faults, Catch::Contains("6: Motorola: ends outside of its message"));
  CHECK_THAT(faults, Catch::Contains("7: Zero: has the factor 0"));
  CHECK_THAT(faults, Catch::Contains("9: Twice: is there twice"));
  CHECK_THAT(faults, Catch::Contains("10: "));
  CHECK_THAT(faults_of(""), Catch::Contains("no message"));
  CHECK_THAT(faults_of("BO_ 1 M: 8 \"X"), Catch::Contains("a text without an end"));
}
