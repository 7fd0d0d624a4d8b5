#include "hal/mirror_rig.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>

#include "hal/types/units.hpp"

using namespace rvbench;
using namespace rvbench::hal;

namespace {

void connect(Rig& rig) {
  REQUIRE(rig.safety->connect());
  REQUIRE(rig.accelerometers->connect());
  REQUIRE(rig.accelerometers->start());
  REQUIRE(rig.torque_sensor->connect());
  REQUIRE(rig.brake->connect());
  REQUIRE(rig.drive->connect());
}

}  // namespace

TEST_CASE("the mirror's shaft follows its command by a ramp", "[hal][mirror]") {
  Rig rig = make_mirror_rig({.ramp_rpm_s = 500, .watchdog = {10, true}});
  connect(rig);
  REQUIRE(rig.drive->set_speed(1000));
  rig.clock->wait_until(1);
  CHECK(rig.drive->read().value().speed_rpm == Approx(500));
  rig.clock->wait_until(3);
  CHECK(rig.drive->read().value().speed_rpm == Approx(1000));
  // 2 s of ramp at 500 rpm on average, then 1 s at 1000 rpm
  const auto block = rig.torque_sensor->read();
  REQUIRE(block);
  CHECK(block.value().samples.size() == 3000);
  CHECK(block.value().t0_s == Approx(0.001));
  CHECK(block.value().samples.back().angle_rad / units::two_pi ==
        Approx(2000.0 / 60).epsilon(1e-3));
  rig.drive->stop();
  rig.clock->wait_until(5.1);
  CHECK(rig.drive->read().value().speed_rpm == 0);
  CHECK_FALSE(rig.drive->read().value().running);
}

TEST_CASE("the mirror's input torque is the brake's over the ratio", "[hal][mirror]") {
  Rig rig = make_mirror_rig({.gear_ratio = 121});
  connect(rig);
  REQUIRE(rig.drive->set_speed(100));
  REQUIRE(rig.brake->set_torque(121));
  rig.clock->wait_until(0.1);
  CHECK(rig.torque_sensor->read().value().samples.back().torque_Nm == Approx(1));
  CHECK(rig.brake->read().value().torque_Nm == 121);
  rig.clock->wait_until(1);  // nobody feeds it
  CHECK(rig.brake->read().value().torque_Nm == 0);
}

TEST_CASE("the mirror's drive stops by its own watchdog when it is left alone", "[hal][mirror]") {
  Rig rig = make_mirror_rig({.ramp_rpm_s = 1000, .watchdog = {1.0, true}});
  connect(rig);
  REQUIRE(rig.drive->set_speed(1000));
  rig.clock->wait_until(1);
  CHECK(rig.drive->read().value().speed_rpm == Approx(1000));
  rig.clock->wait_until(2.1);
  CHECK(rig.drive->read().value().speed_rpm == 0);
}

TEST_CASE("the mirror's accelerations are zero and come without gaps", "[hal][mirror]") {
  Rig rig = make_mirror_rig();
  connect(rig);
  Eigen::Index scans = 0;
  for (int tick = 1; tick <= 100; ++tick) {
    rig.clock->wait_until(tick * 0.01);
    const auto block = rig.accelerometers->read();
    REQUIRE(block);
    CHECK(block.value().t0_s == Approx(double(scans) / 4960));
    CHECK(block.value().scans.cwiseAbs().maxCoeff() == 0);
    scans += block.value().scans.rows();
  }
  CHECK(scans == 4960);
  CHECK(rig.accelerometers->channels().size() == 12);
  CHECK(rig.accelerometers->channels()[0].name == "accel_1x");
}

TEST_CASE("a dead device runs into its deadline, a frozen one repeats itself", "[hal][mirror]") {
  Rig rig = make_mirror_rig({.deadline_s = 0.02});
  connect(rig);
  mirror_world(rig).schedule(MirrorFault::drive_dead, 1, 2);
  mirror_world(rig).schedule(MirrorFault::torque_sensor_frozen, 1);
  rig.clock->wait_until(0.9);
  const double t0_s = rig.torque_sensor->read().value().t0_s;
  CHECK(rig.drive->read());
  rig.clock->wait_until(1);
  CHECK(rig.torque_sensor->read().value().t0_s == t0_s);
  CHECK(rig.drive->read().error().code == IoErrc::timeout);
  CHECK(rig.clock->now_s() == Approx(1.02));
  rig.clock->wait_until(2);
  CHECK(rig.drive->read());
}

TEST_CASE("a command beyond the mirror's limits is the caller's bug", "[hal][mirror]") {
  Rig rig = make_mirror_rig();
  connect(rig);
  CHECK_THROWS_AS(rig.drive->set_speed(3001), std::invalid_argument);
  CHECK_THROWS_AS(rig.drive->set_speed(not_known), std::invalid_argument);
  CHECK_THROWS_AS(rig.brake->set_torque(-1), std::invalid_argument);
  CHECK_THROWS_AS(rig.brake->set_torque(401), std::invalid_argument);
}

TEST_CASE("before connect, the mirror's devices report a dead link", "[hal][mirror]") {
  Rig rig = make_mirror_rig();
  CHECK(rig.drive->read().error().code == IoErrc::disconnected);
  CHECK(rig.brake->read().error().code == IoErrc::disconnected);
  CHECK(rig.torque_sensor->read().error().code == IoErrc::disconnected);
  CHECK(rig.accelerometers->read().error().code == IoErrc::disconnected);
  CHECK(rig.safety->read().error().code == IoErrc::disconnected);
}
