#include "hal/modbus/drive_words.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>
#include <tuple>

#include "hal/modbus/drive_profile_json.hpp"

using namespace rvbench::hal;
using Writes = std::vector<DriveWrite>;

namespace {

constexpr MotorPlate two_pole_pairs{.pole_pairs = 2, .rated_Hz = 50};

DriveState state_by(const DriveProfile& profile, std::uint16_t address, std::uint16_t word) {
  DriveWords words;
  for (const DriveBlock& block : status_blocks(profile)) {
    for (int i = 0; i < block.count; ++i) {
      words[static_cast<std::uint16_t>(block.address + i)] = 0;
    }
  }
  words.at(address) = word;  // throws if it is not among those that are read
  return state_of(profile, words);
}

}  // namespace

TEST_CASE("a speed becomes a run word and a frequency", "[hal][modbus]") {
  const DriveProfile generic = drive_profile("rvbench_generic");
  // 1815 rpm = 30.25 rev/s; with 2 pole pairs 60.50 Hz.
  CHECK(words_for_speed(generic, 1815, {2, 50}) == Writes{{0x0101, 6050}, {0x0100, 1}});
  CHECK(words_for_speed(generic, -1815, {2, 50}) == Writes{{0x0101, 6050}, {0x0100, 2}});
  CHECK(words_for_speed(generic, 600, {1, 50}) == Writes{{0x0101, 1000}, {0x0100, 1}});
  CHECK(words_for_speed(generic, 0, {2, 50}) == Writes{{0x0100, 0}, {0x0101, 0}});
  // Below the resolution of 0.01 Hz.
  CHECK(words_for_speed(generic, 0.1, {2, 50}) == words_for_stop(generic));
  CHECK_THROWS_AS(words_for_speed(generic, 3276, {13, 50}), std::invalid_argument);
}

TEST_CASE("status words become physical values", "[hal][modbus]") {
  const DriveProfile generic = drive_profile("rvbench_generic");
  const auto status = drive_status(
      generic, {{0x200, 0x0005}, {0x201, 2017}, {0x202, 321}, {0x203, 0xE8F6}, {0x204, 0}},
      two_pole_pairs);
  REQUIRE(status);
  CHECK(status->output_frequency_Hz == Approx(-20.17));
  CHECK(status->current_A == Approx(3.21));
  CHECK(status->speed_rpm == Approx(-589.8));  // 0xE8F6 = 59638 = -5898 in 16 bits
  CHECK(status->running);
  CHECK(status->remote);
  CHECK_FALSE(status->tripped);
  const auto with = [&](std::uint16_t bits, std::uint16_t fault) {
    return drive_status(generic,
                        {{0x200, bits}, {0x201, 0}, {0x202, 0}, {0x203, 0}, {0x204, fault}},
                        two_pole_pairs);
  };
  CHECK(with(0x0002, 17)->fault_code == 17);
  CHECK(with(0x0002, 17)->tripped);
  CHECK(with(0x0003, 17)->running);  // tripped, and still on its ramp
  CHECK_FALSE(with(0x0008, 0)->remote);
  CHECK_FALSE(with(0x0010, 0));  // a bit that the drive never sets
}

TEST_CASE("neighbouring registers are read by one request, where the drive allows it",
          "[hal][modbus]") {
  DriveProfile generic = drive_profile("rvbench_generic");
  CHECK(status_blocks(generic) == std::vector<DriveBlock>{{0x0200, 5}});
  CHECK(identity_blocks(generic) == std::vector<DriveBlock>{{0x0000, 2}});
  CHECK(watchdog_blocks(generic) == std::vector<DriveBlock>{{0x0002, 2}});
  generic.reads_blocks = false;
  CHECK(status_blocks(generic) ==
        std::vector<DriveBlock>{{0x0200, 1}, {0x0201, 1}, {0x0202, 1}, {0x0203, 1}, {0x0204, 1}});
  // 16140 and 16170 are numbers of two registers; printed numbers are one above the wire's.
  CHECK(status_blocks(drive_profile("danfoss_fc")) ==
        std::vector<DriveBlock>{{16139, 2}, {16169, 2}, {50199, 1}, {50209, 1}});
}

TEST_CASE("numbers of two registers have the higher word first", "[hal][modbus]") {
  const DriveRegister current{.address = 10, .words = 2, .scale = 0.01};
  CHECK(value_of(current, {{10, 1}, {11, 0}}) == Approx(655.36));
  const DriveRegister speed{.address = 10, .words = 2, .is_signed = true};
  CHECK(value_of(speed, {{10, 0xFFFF}, {11, 0xFDA3}}) == -605);
}

TEST_CASE("CiA 402 states are told as its tables tell them", "[hal][modbus]") {
  const DriveProfile altivar = drive_profile("schneider_altivar");
  const auto of = [&](std::uint16_t word) { return state_by(altivar, 3201, word); };
  CHECK(of(0x0000) == DriveState::not_ready);
  CHECK(of(0x0250) == DriveState::inhibited);
  CHECK(of(0x0231) == DriveState::ready);
  CHECK(of(0x0233) == DriveState::switched_on);
  CHECK(of(0x0237) == DriveState::running);
  CHECK(of(0x0637) == DriveState::running);  // at its setpoint
  CHECK(of(0x0217) == DriveState::quick_stop);
  CHECK(of(0x021F) == DriveState::fault_reaction);
  CHECK(of(0x0218) == DriveState::fault);
}

TEST_CASE("other families' words lead to the same states", "[hal][modbus]") {
  const auto of = [](const char* family, std::uint16_t address, std::uint16_t word) {
    return state_by(drive_profile(family), address, word);
  };
  // ABB: RDY_ON, RDY_RUN, RDY_REF, TRIPPED, OFF2/OFF3 inactive, SWC_ON_INHIB, REMOTE
  CHECK(of("abb_acs", 3, 0x0270) == DriveState::inhibited);
  CHECK(of("abb_acs", 3, 0x0231) == DriveState::ready);
  CHECK(of("abb_acs", 3, 0x0233) == DriveState::switched_on);
  CHECK(of("abb_acs", 3, 0x0237) == DriveState::running);
  CHECK(of("abb_acs", 3, 0x0217) == DriveState::quick_stop);
  CHECK(of("abb_acs", 3, 0x0238) == DriveState::fault);
  CHECK(of("abb_acs", 3, 0x0000) == DriveState::not_ready);
  CHECK(of("siemens_v20", 0x6D, 0x0237) == DriveState::running);
  CHECK(of("siemens_v20", 0x6D, 0x0240) == DriveState::inhibited);
  CHECK(of("danfoss_fc", 50199, 0x0A07) == DriveState::running);
  CHECK(of("danfoss_fc", 50199, 0x0207) == DriveState::ready);
  CHECK(of("danfoss_fc", 50199, 0x0203) == DriveState::inhibited);  // coasted
  CHECK(of("danfoss_fc", 50199, 0x0008) == DriveState::fault);
  CHECK(of("delta_ms300", 0x2101, 0x0503) == DriveState::running);
  CHECK(of("delta_ms300", 0x2101, 0x0501) == DriveState::running);  // stopping
  CHECK(of("delta_ms300", 0x2101, 0x0500) == DriveState::ready);
  CHECK(of("delta_ms300", 0x2100, 0x0009) == DriveState::fault);
  CHECK(of("delta_ms300", 0x2100, 0x0900) == DriveState::ready);  // a warning only
}

TEST_CASE("605 rpm are told to each family in its own words", "[hal][modbus]") {
  const auto told = [](const char* family, double speed_rpm) {
    return words_for_speed(drive_profile(family), speed_rpm, two_pole_pairs);
  };
  // 605 rpm with 2 pole pairs are 20.1667 Hz, 40.333 % of 50 Hz.
  CHECK(told("delta_ms300", 605) == Writes{{0x2001, 2017}, {0x2000, 0x0012}});
  CHECK(told("delta_ms300", -605) == Writes{{0x2001, 2017}, {0x2000, 0x0022}});
  CHECK(told("abb_acs", 605) == Writes{{1, 8067}, {0, 0x047F}});  // 20000 = 100 %
  CHECK(told("abb_acs", -605) == Writes{{1, 0xE07D}, {0, 0x047F}});
  CHECK(told("schneider_altivar", 605) == Writes{{8602, 605}, {8501, 0x000F}});
  CHECK(told("danfoss_fc", 605) == Writes{{50009, 6608}, {49999, 0x047C}});  // 16384 = 100 %
  CHECK(told("danfoss_fc", -605) == Writes{{50009, 6608}, {49999, 0x847C}});
  CHECK(told("siemens_v20", 605) == Writes{{0x64, 6608}, {0x63, 0x047F}});
  CHECK(told("siemens_v20", -605) == Writes{{0x64, 6608}, {0x63, 0x0C7F}});
}

TEST_CASE("a watchdog counts when it is on and stops the motor", "[hal][modbus]") {
  const DriveProfile delta = drive_profile("delta_ms300");
  const auto read = [&](std::uint16_t action, std::uint16_t timeout_ds) {
    const DriveWatchdog told = drive_watchdog(delta, {{0x0902, action}, {0x0903, timeout_ds}});
    return std::tuple(told.timeout_s, told.stops_motor);
  };
  CHECK(read(3, 0) == std::tuple(0.0, false));  // as the factory leaves it
  CHECK(read(1, 0) == std::tuple(0.0, false));
  CHECK(read(1, 10) == std::tuple(1.0, true));
  CHECK(read(2, 10) == std::tuple(1.0, true));
  CHECK(read(0, 10) == std::tuple(1.0, false));
  CHECK(read(3, 10) == std::tuple(1.0, false));
  DriveProfile mute = delta;
  mute.watchdog.reset();
  CHECK_FALSE(drive_watchdog(mute, {}).stops_motor);
}
