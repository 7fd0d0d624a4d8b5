#include <catch2/catch.hpp>
#include <string>

#include "hal/modbus/drive_profile_json.hpp"
#include "hal/modbus/modbus_inverter.hpp"
#include "hal/steady_clock.hpp"
#include "tests/support/program.hpp"
#include "tests/support/this_build.hpp"
#include "tests/support/wait_until.hpp"

using namespace rvbench;

namespace {

const std::string standin_path = test::source_dir() / "tests/peers/drive_standin.py";

// A drive of one family, served by python3-pymodbus.
class Standin {
 public:
  explicit Standin(const std::string& family) : program_(".", {standin_path, family, "tcp"}) {
    arise();
  }
  Standin(const std::string& family, const std::string& device)
      : program_(".", {standin_path, family, "rtu", device}) {
    arise();
  }

  std::uint16_t port() {
    const std::string said = program_.said();
    return static_cast<std::uint16_t>(std::stoi(said.substr(said.find("listening at ") + 13)));
  }
  bool says(const std::string& text) { return program_.says(text); }

 private:
  void arise() {
    INFO("needs python3-pymodbus and python3-serial-asyncio: bench/install_packages --tests");
    const bool listens = program_.says("listening at ");
    INFO(program_.said());
    REQUIRE(listens);
  }

  test::Program program_;
};

// Sets the speed as a sequencer does, again and again, until the drive runs.
bool starts(hal::Drive& drive, double speed_rpm) {
  return test::wait_until([&] {
    REQUIRE(drive.set_speed(speed_rpm));
    const auto status = drive.read();
    REQUIRE(status);
    return status.value().running && std::abs(status.value().speed_rpm) > 1;
  });
}

void drive_through(hal::Drive& drive, Standin& standin) {
  const auto connected = drive.connect();
  INFO((connected ? "" : describe(connected.error())));
  REQUIRE(connected);
  const auto watchdog = drive.read_watchdog();
  REQUIRE(watchdog);
  CHECK(watchdog.value().timeout_s == Approx(1));
  CHECK(watchdog.value().stops_motor);
  for (const double speed_rpm : {605.0, -1210.0}) {
    INFO(speed_rpm);
    REQUIRE(starts(drive, speed_rpm));
    const auto status = drive.read();
    REQUIRE(status);
    CHECK(status.value().speed_rpm == Approx(speed_rpm).margin(1));
    CHECK(status.value().output_frequency_Hz == Approx(speed_rpm / 30).margin(0.05));
    CHECK(status.value().remote);
    CHECK_FALSE(status.value().tripped);
    drive.stop();
    const auto stopped = drive.read();
    REQUIRE(stopped);
    CHECK_FALSE(stopped.value().running);
    CHECK(stopped.value().speed_rpm == 0);
  }
  CHECK(standin.says("state ready"));
  CHECK(drive.retries() == 0);
}

hal::ModbusInverterOptions options(const std::string& family, hal::ModbusPath path) {
  return {.profile = hal::drive_profile(family),
          .path = std::move(path),
          .response_timeout_s = 1,
          .limits = {.max_speed_rpm = 1900}};
}

}  // namespace

TEST_CASE("each family's start, direction and stop are understood by a drive that is not ours",
          "[peer][modbus]") {
  const std::string family =
      GENERATE("delta_ms300", "abb_acs", "schneider_altivar", "siemens_v20", "danfoss_fc");
  INFO(family);
  Standin standin(family);
  hal::SteadyClock clock;
  hal::ModbusInverter drive(options(family, hal::ModbusTcp{"127.0.0.1", standin.port()}), clock);
  drive_through(drive, standin);
}

TEST_CASE("a drive on a serial line that is not ours is driven alike", "[peer][modbus][rtu]") {
  const test::ScratchFolder folder;
  const std::string ours = folder / "ours", theirs = folder / "theirs";
  test::Program cable(".", {"/usr/bin/socat", "-d", "-d", "pty,raw,echo=0,link=" + ours,
                            "pty,raw,echo=0,link=" + theirs});
  INFO("needs socat: bench/install_packages --tests");
  REQUIRE(cable.says("starting data transfer loop"));
  const std::string family = GENERATE("delta_ms300", "schneider_altivar");
  Standin standin(family, theirs);
  hal::SteadyClock clock;
  hal::ModbusInverter drive(options(family, hal::ModbusRtu{ours}), clock);
  drive_through(drive, standin);
}
