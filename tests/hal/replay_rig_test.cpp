#include "hal/replay_rig.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>

#include "tests/contracts/accelerometers_contract.hpp"
#include "tests/contracts/brake_contract.hpp"
#include "tests/contracts/clock_contract.hpp"
#include "tests/contracts/drive_contract.hpp"
#include "tests/contracts/safety_inputs_contract.hpp"
#include "tests/contracts/torque_sensor_contract.hpp"
#include "tests/hal/recording_fixture.hpp"

namespace rvbench::hal {
namespace {

using test::ScratchFolder;

constexpr double rate_Hz = 1000;
constexpr int scans = 800;

// Each scan tells the point and its own number: 1000 * (point + 1) + scan.
std::filesystem::path record(const ScratchFolder& scratch, std::vector<PlannedPoint> points) {
  RecordingLayout layout = test::layout_of(1, 2);
  layout.acceleration_rate_Hz = rate_Hz;
  layout.points = std::move(points);
  const auto made = RecordingWriter::create(scratch / "r.h5", layout);
  REQUIRE(made);
  for (int point = 0; point < static_cast<int>(layout.points.size()); ++point) {
    REQUIRE(made.value()->append(
        point, test::acceleration_block(10 * point, 1000 * (point + 1), scans, 2)));
    REQUIRE(made.value()->append(point, test::torque_block(10 * point, 0, scans)));
    const double speed_rpm = layout.points[static_cast<std::size_t>(point)].speed_rpm;
    REQUIRE(made.value()->end_point({point, 10.0 * point, "ok", speed_rpm - 0.5, 3}));
  }
  REQUIRE(made.value()->close());
  return scratch / "r.h5";
}

Rig replay(const std::filesystem::path& file, double lead_in_s = 0.2, bool real_time = false) {
  auto made = make_replay_rig(
      file, {.rated_output_torque_Nm = 167, .lead_in_s = lead_in_s, .real_time = real_time});
  REQUIRE(made);
  return std::move(made).value();
}

void connect(Rig& rig) {
  REQUIRE(rig.drive->connect());
  REQUIRE(rig.brake->connect());
  REQUIRE(rig.safety->connect());
  REQUIRE(rig.torque_sensor->connect());
  REQUIRE(rig.accelerometers->connect());
  REQUIRE(rig.accelerometers->start());
}

// Commands a point and returns the first scans of channel 1 from the end of the lead-in on.
Eigen::VectorXf play(Rig& rig, double speed_rpm, double load_pct, double lead_in_s = 0.2) {
  REQUIRE(rig.drive->set_speed(speed_rpm));
  REQUIRE(rig.brake->set_torque(1.67 * load_pct));
  if (lead_in_s > 0) {
    rig.clock->wait_until(rig.clock->now_s() + lead_in_s);
    REQUIRE(rig.accelerometers->read());
  }
  rig.clock->wait_until(rig.clock->now_s() + 0.3);
  const auto read = rig.accelerometers->read();
  REQUIRE(read);
  return read.value().scans.col(0);
}

}  // namespace

TEST_CASE("a replayed clock keeps the clock's contract", "[hal][replay]") {
  const ScratchFolder scratch;
  const Rig rig = replay(record(scratch, {{605, 50, 1}}));
  test::check_clock_contract(*rig.clock);
}

TEST_CASE("a replayed drive keeps the drive's contract", "[hal][replay]") {
  const ScratchFolder scratch;
  const Rig rig = replay(record(scratch, {{605, 50, 1}}));
  test::check_drive_contract(*rig.drive);
}

TEST_CASE("a replayed brake keeps the brake's contract", "[hal][replay]") {
  const ScratchFolder scratch;
  const Rig rig = replay(record(scratch, {{605, 50, 1}}));
  test::check_brake_contract(*rig.brake, *rig.clock);
}

TEST_CASE("a replayed torque sensor keeps the sensor's contract", "[hal][replay]") {
  const ScratchFolder scratch;
  const Rig rig = replay(record(scratch, {{605, 50, 1}}));
  REQUIRE(rig.drive->connect());
  REQUIRE(rig.drive->set_speed(605));
  test::check_torque_sensor_contract(*rig.torque_sensor, *rig.clock);
}

TEST_CASE("replayed accelerometers keep the accelerometers' contract", "[hal][replay]") {
  const ScratchFolder scratch;
  const Rig rig = replay(record(scratch, {{605, 50, 1}}));
  REQUIRE(rig.drive->connect());
  REQUIRE(rig.drive->set_speed(605));
  test::check_accelerometers_contract(*rig.accelerometers, *rig.clock);
}

TEST_CASE("replayed safety inputs keep the inputs' contract", "[hal][replay]") {
  const ScratchFolder scratch;
  const Rig rig = replay(record(scratch, {{605, 50, 1}}));
  test::check_safety_inputs_contract(*rig.safety);
}

TEST_CASE("a clock of a replay in real time keeps the clock's contract", "[hal][replay]") {
  const ScratchFolder scratch;
  const Rig rig = replay(record(scratch, {{605, 50, 1}}), 0.2, true);
  CHECK_FALSE(rig.clock->is_virtual());
  test::check_clock_contract(*rig.clock);
}

TEST_CASE("a replay in real time goes on as it was recorded, whoever reads late", "[hal][replay]") {
  const ScratchFolder scratch;
  Rig rig = replay(record(scratch, {{605, 0, 1}}), 0, true);
  const double from_s = rig.clock->now_s();
  connect(rig);
  const auto connected = std::chrono::steady_clock::now();
  REQUIRE(rig.drive->set_speed(605));
  rig.clock->wait_until(rig.clock->now_s() + 0.05);
  const auto first = rig.accelerometers->read();
  // A reader who is late, and does not wait for the rig's clock.
  while (std::chrono::steady_clock::now() - connected < std::chrono::milliseconds(300)) {
  }
  const auto second = rig.accelerometers->read();
  REQUIRE(first);
  REQUIRE(second);
  const auto& earlier = first.value().scans;
  const auto& later = second.value().scans;
  CHECK(earlier.rows() >= 49);
  const double read_scans = double(earlier.rows() + later.rows());
  CHECK(read_scans >= 0.3 * rate_Hz - 1);
  CHECK(read_scans <= (rig.clock->now_s() - from_s) * rate_Hz + 1);
  // One after the other, none skipped, and round again: point 0 has the numbers 1000 to 1799.
  const auto after = [](float number, Eigen::Index steps) {
    return 1000 + float((Eigen::Index(number) - 1000 + steps) % scans);
  };
  CHECK(later(0, 0) == after(earlier(earlier.rows() - 1, 0), 1));
  CHECK(later(later.rows() - 1, 0) == after(later(0, 0), later.rows() - 1));
}

TEST_CASE("a commanded point is played from its first sample after the lead-in", "[hal][replay]") {
  const ScratchFolder scratch;
  Rig rig = replay(record(scratch, {{605, 0, 1}, {605, 100, 1}, {1210, 0, 1}}));
  connect(rig);
  const Eigen::VectorXf second = play(rig, 605, 100);
  REQUIRE(second.size() == 300);
  for (int i : {0, 1, 150, 299}) {
    CAPTURE(i);
    CHECK(second[i] == static_cast<float>(2000 + i));
  }
  CHECK(rig.drive->read().value().speed_rpm == 604.5);  // as measured then, not as commanded
  CHECK(rig.brake->read().value().torque_Nm == Approx(167));
  CHECK(play(rig, 1210, 0)[0] == 3000);
  CHECK(play(rig, 600, 5)[0] == 1000);  // the nearest
}

TEST_CASE("the same plan meets the same repeats, whatever the warm-up was", "[hal][replay]") {
  const ScratchFolder scratch;
  const auto file =
      record(scratch, {{605, 0, 1}, {605, 50, 1}, {605, 0, 2}, {605, 50, 2}, {1210, 0, 1}});
  Rig rig = replay(file);
  connect(rig);
  play(rig, 1210, 0);
  play(rig, 605, 50);
  CHECK(play(rig, 605, 0)[0] == 1000);
  CHECK(play(rig, 605, 50)[0] == 2000);
  CHECK(play(rig, 605, 0)[0] == 3000);
  CHECK(play(rig, 605, 50)[0] == 4000);
  CHECK(play(rig, 1210, 0)[0] == 5000);
}

TEST_CASE("a point goes round as long as it is asked for, and the angle goes on", "[hal][replay]") {
  const ScratchFolder scratch;
  Rig rig = replay(record(scratch, {{605, 50, 1}, {1210, 50, 1}}), 0);
  connect(rig);
  REQUIRE(rig.brake->set_torque(83.5));
  double last_rad = not_known;
  for (const double speed_rpm : {605, 1210, 0}) {
    CAPTURE(speed_rpm);
    REQUIRE(rig.drive->set_speed(speed_rpm));
    const double step_rad = speed_rpm == 0 ? 0 : test::angle_rad(1) - test::angle_rad(0);
    for (int tick = 0; tick < 20; ++tick) {  // 2 s of a recording of 0.8 s
      rig.clock->wait_until(rig.clock->now_s() + 0.1);
      const auto read = rig.torque_sensor->read();
      REQUIRE(read);
      for (const TorqueSample& sample : read.value().samples) {
        if (!std::isnan(last_rad))
          CHECK(sample.angle_rad - last_rad == Approx(step_rad).margin(1e-9));
        last_rad = sample.angle_rad;
      }
    }
  }
}

TEST_CASE("at standstill a replayed bench is silent", "[hal][replay]") {
  const ScratchFolder scratch;
  Rig rig = replay(record(scratch, {{605, 50, 1}}));
  connect(rig);
  play(rig, 605, 50);
  rig.drive->stop();
  rig.clock->wait_until(rig.clock->now_s() + 0.1);
  const auto accelerations = rig.accelerometers->read();
  REQUIRE(accelerations);
  CHECK(accelerations.value().scans.cwiseAbs().maxCoeff() == 0);
  CHECK(rig.drive->read().value().speed_rpm == 0);
  CHECK_FALSE(rig.drive->read().value().running);
  REQUIRE(rig.torque_sensor->read());
  rig.clock->wait_until(rig.clock->now_s() + 0.1);
  CHECK(rig.torque_sensor->read().value().samples.back().torque_Nm == 0);
}

TEST_CASE("what was lost when recording is lost again", "[hal][replay]") {
  const ScratchFolder scratch;
  RecordingLayout layout = test::layout_of(1, 2);
  layout.acceleration_rate_Hz = rate_Hz;
  {
    const auto made = RecordingWriter::create(scratch / "r.h5", layout);
    REQUIRE(made);
    AccelerationBlock block = test::acceleration_block(0, 0, scans, 2);
    block.scans(7, 1) = std::nanf("");
    TorqueBlock torque = test::torque_block(0, 0, scans);
    torque.samples[3] = TorqueSample{};
    REQUIRE(made.value()->append(0, block));
    REQUIRE(made.value()->append(0, torque));
    REQUIRE(made.value()->end_point({0, 0, "samples_lost", 605, 3}));
  }
  Rig rig = replay(scratch / "r.h5", 0);
  connect(rig);
  REQUIRE(rig.drive->set_speed(605));
  rig.clock->wait_until(0.1);
  CHECK(rig.accelerometers->read().value().lost == 1);
  CHECK(rig.torque_sensor->read().value().lost == 1);
}

TEST_CASE("what cannot stand for a bench is refused", "[hal][replay]") {
  const ScratchFolder scratch;
  const auto none = make_replay_rig(scratch / "none.h5");
  REQUIRE_FALSE(none);
  CHECK_THAT(none.error().where, Catch::Contains("no such file"));

  RecordingLayout layout = test::layout_of(1, 2);
  REQUIRE(RecordingWriter::create(scratch / "nothing.h5", layout));
  const auto nothing = make_replay_rig(scratch / "nothing.h5");
  REQUIRE_FALSE(nothing);
  CHECK_THAT(nothing.error().where, Catch::Contains("no point that settled and ended"));

  layout.torque_rate_Hz = 0;
  REQUIRE(RecordingWriter::create(scratch / "no_torque.h5", layout));
  const auto no_torque = make_replay_rig(scratch / "no_torque.h5");
  REQUIRE_FALSE(no_torque);
  CHECK_THAT(no_torque.error().where, Catch::Contains("no torque"));
}

}  // namespace rvbench::hal
