#include <catch2/catch.hpp>
#include <memory>

#include "hal/simulated_rig.hpp"
#include "tests/contracts/accelerometers_contract.hpp"
#include "tests/contracts/bare_plant.hpp"
#include "tests/contracts/brake_contract.hpp"
#include "tests/contracts/clock_contract.hpp"
#include "tests/contracts/drive_contract.hpp"
#include "tests/contracts/safety_inputs_contract.hpp"
#include "tests/contracts/torque_sensor_contract.hpp"

using namespace rvbench;

namespace {

hal::Rig make_rig() { return hal::make_simulated_rig(std::make_unique<test::BarePlant>()); }

}  // namespace

TEST_CASE("the simulated rig's drive keeps the drive contract", "[hal][contract]") {
  const hal::Rig rig = make_rig();
  test::check_drive_contract(*rig.drive);
  test::check_drive_obeys(*rig.drive, *rig.clock, 3);
}

TEST_CASE("the simulated rig's brake keeps the brake contract", "[hal][contract]") {
  const hal::Rig rig = make_rig();
  test::check_brake_contract(*rig.brake, *rig.clock);
  test::check_brake_obeys(*rig.brake, *rig.clock);
}

TEST_CASE("the simulated rig's torque sensor keeps the torque sensor contract", "[hal][contract]") {
  const hal::Rig rig = make_rig();
  test::check_torque_sensor_contract(*rig.torque_sensor, *rig.clock);
}

TEST_CASE("the simulated rig's accelerometers keep the accelerometers contract",
          "[hal][contract]") {
  const hal::Rig rig = make_rig();
  test::check_accelerometers_contract(*rig.accelerometers, *rig.clock);
}

TEST_CASE("the simulated rig's safety inputs keep the safety inputs contract", "[hal][contract]") {
  const hal::Rig rig = make_rig();
  test::check_safety_inputs_contract(*rig.safety);
}

TEST_CASE("the simulated rig's clock keeps the clock contract", "[hal][contract]") {
  const hal::Rig rig = make_rig();
  test::check_clock_contract(*rig.clock);
  SECTION("ten simulated minutes pass when asked for") {
    CHECK(rig.clock->is_virtual());
    rig.clock->wait_until(600);
    CHECK(rig.clock->now_s() == Approx(600));
  }
}

SCENARIO("a simulated rig tells a device that went silent from a sound one", "[hal]") {
  auto owned = std::make_unique<test::BarePlant>();
  test::BarePlant& plant = *owned;
  const hal::Rig rig = hal::make_simulated_rig(std::move(owned));
  REQUIRE(rig.accelerometers->connect());
  REQUIRE(rig.accelerometers->start());
  rig.clock->wait_until(0.1);
  REQUIRE(rig.accelerometers->read());
  WHEN("the DAQ gives no more scans") {
    plant.daq_alive = false;
    THEN("read waits for nothing, and says so once the deadline has passed") {
      const double lost_s = rig.clock->now_s();
      const auto empty = rig.accelerometers->read();
      REQUIRE(empty);
      CHECK(empty.value().scans.rows() == 0);
      CHECK(rig.clock->now_s() == lost_s);
      rig.clock->wait_until(lost_s + 0.205);
      const auto block = rig.accelerometers->read();
      REQUIRE_FALSE(block);
      CHECK(block.error().code == IoErrc::timeout);
    }
  }
  WHEN("an E-stop is pressed") {
    REQUIRE(rig.safety->connect());
    plant.safety.estop_pressed = true;
    THEN("the next reading has it") { CHECK(rig.safety->read().value().estop_pressed); }
  }
}

TEST_CASE("a simulated rig without a plant is the caller's bug", "[hal]") {
  CHECK_THROWS_AS(hal::make_simulated_rig(nullptr), std::invalid_argument);
}
