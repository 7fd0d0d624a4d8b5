#include <catch2/catch.hpp>

#include "hal/mirror_rig.hpp"
#include "tests/contracts/accelerometers_contract.hpp"
#include "tests/contracts/brake_contract.hpp"
#include "tests/contracts/clock_contract.hpp"
#include "tests/contracts/drive_contract.hpp"
#include "tests/contracts/safety_inputs_contract.hpp"
#include "tests/contracts/torque_sensor_contract.hpp"

using namespace rvbench;

TEST_CASE("the mirror rig's drive keeps the drive contract", "[hal][contract]") {
  const hal::Rig rig = hal::make_mirror_rig();
  test::check_drive_contract(*rig.drive);
  test::check_drive_obeys(*rig.drive, *rig.clock, 3);
}

TEST_CASE("the mirror rig's brake keeps the brake contract", "[hal][contract]") {
  const hal::Rig rig = hal::make_mirror_rig();
  test::check_brake_contract(*rig.brake, *rig.clock);
  test::check_brake_obeys(*rig.brake, *rig.clock);
}

TEST_CASE("the mirror rig's torque sensor keeps the torque sensor contract", "[hal][contract]") {
  const hal::Rig rig = hal::make_mirror_rig();
  test::check_torque_sensor_contract(*rig.torque_sensor, *rig.clock);
}

TEST_CASE("the mirror rig's accelerometers keep the accelerometers contract", "[hal][contract]") {
  const hal::Rig rig = hal::make_mirror_rig();
  test::check_accelerometers_contract(*rig.accelerometers, *rig.clock);
}

TEST_CASE("the mirror rig's safety inputs keep the safety inputs contract", "[hal][contract]") {
  const hal::Rig rig = hal::make_mirror_rig();
  test::check_safety_inputs_contract(*rig.safety);
}

TEST_CASE("the mirror rig's clock keeps the clock contract", "[hal][contract]") {
  const hal::Rig rig = hal::make_mirror_rig();
  test::check_clock_contract(*rig.clock);
}
