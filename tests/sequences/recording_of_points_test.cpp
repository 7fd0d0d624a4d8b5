#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <utility>

#include "hal/types/units.hpp"
#include "sequences/bench_loop.hpp"
#include "tests/sequences/run_fixture.hpp"
#include "tests/support/passing_devices.hpp"

using namespace rvbench;
using hal::MirrorFault;
using test::Run;
using test::small_plan;

namespace {

constexpr double lost_from_s = 12.0;
constexpr double lost_until_s = 12.055;  // before anything counts as stale

// For some ticks not one scan comes through.
class LosingAccelerometers final : public test::PassingAccelerometers {
 public:
  LosingAccelerometers(std::unique_ptr<hal::Accelerometers> whole, double until_s)
      : PassingAccelerometers(std::move(whole)), until_s_(until_s) {}

 protected:
  void show(hal::AccelerationBlock& block) override {
    if (block.t0_s < lost_from_s || block.t0_s > until_s_) return;
    block.scans.setConstant(float(not_known));
    block.lost = int(block.scans.rows());
  }

 private:
  double until_s_;
};

// For so long the scans are gone, and the device counts on as if there had been none.
class SwallowingAccelerometers final : public test::PassingAccelerometers {
 public:
  SwallowingAccelerometers(std::unique_ptr<hal::Accelerometers> whole, double until_s)
      : PassingAccelerometers(std::move(whole)), until_s_(until_s) {}

 protected:
  void show(hal::AccelerationBlock& block) override {
    if (block.t0_s >= lost_from_s && block.t0_s < until_s_) {
      swallowed_s_ += double(block.scans.rows()) / rate_Hz();
      block = {};
      return;
    }
    block.t0_s -= swallowed_s_;
  }

 private:
  double until_s_;
  double swallowed_s_ = 0;
};

// A transducer that is wired or scaled wrongly, or becomes so.
class ScaledTorqueSensor final : public test::PassingTorqueSensor {
 public:
  ScaledTorqueSensor(std::unique_ptr<hal::TorqueSensor> sensor, double factor, double from_s = 0)
      : PassingTorqueSensor(std::move(sensor)), factor_(factor), from_s_(from_s) {}

 protected:
  void show(hal::TorqueBlock& block) override {
    if (block.t0_s < from_s_) return;
    for (hal::TorqueSample& sample : block.samples) sample.torque_Nm *= factor_;
  }

 private:
  double factor_;
  double from_s_;
};

// Of which for some ticks neither torque nor angle comes through.
class LosingTorqueSensor final : public test::PassingTorqueSensor {
 public:
  LosingTorqueSensor(std::unique_ptr<hal::TorqueSensor> whole, double until_s)
      : PassingTorqueSensor(std::move(whole)), until_s_(until_s) {}

 protected:
  void show(hal::TorqueBlock& block) override {
    if (block.t0_s < lost_from_s || block.t0_s > until_s_) return;
    block.samples.assign(block.samples.size(), {});
    block.lost = int(block.samples.size());
  }

 private:
  double until_s_;
};

}  // namespace

TEST_CASE("a record holds the turns asked for, on both sample clocks", "[sequences]") {
  Run run;
  run.go();
  const auto& point = run.recording.points.at(0);
  // 4 output turns at 15 rpm are 16 s.
  const double both_from_s = std::max(point.accelerations_from_s, point.torque_from_s);
  const double both_to_s =
      std::min(point.accelerations_to_s, point.torque_from_s + double(point.torque.size()) / 1000);
  CHECK(both_to_s - both_from_s >= 16.0);
  CHECK(both_to_s - both_from_s <= 16.05);
  const double turns =
      (point.torque.back().angle_rad - point.torque.front().angle_rad) / units::two_pi / 121;
  CHECK(turns == Approx(4).margin(0.01));
  CHECK(double(point.scans) / 4960 == Approx(16).margin(0.05));
}

TEST_CASE("a slipping motor is recorded longer, for turns count and not seconds", "[sequences]") {
  Run run({.slip_pct = 4});
  const auto& summary = run.go();
  CHECK(summary.ending.outcome == Outcome::pass);
  CHECK(summary.points.at(0).speed_rpm == Approx(0.96 * 1815).epsilon(1e-4));
  CHECK(double(run.recording.points.at(0).scans) / 4960 == Approx(16 / 0.96).margin(0.05));
}

TEST_CASE("what does not settle makes the run INVALID, and the run goes on", "[sequences]") {
  const auto fault = GENERATE(MirrorFault::uneven_speed, MirrorFault::brake_slack);
  Run run;
  run.world().schedule(fault, 2, 33);  // over the first point's 30 s of patience
  auto text = small_plan;
  text.replace(text.find("[100]"), 5, "[100, 50]");
  const auto& summary = run.go(text);
  CHECK(summary.ending.outcome == Outcome::invalid);
  REQUIRE(summary.points.size() == 2);
  CHECK(summary.points[0].status == "unsettled");
  CHECK(summary.points[1].status == "ok");
  CHECK(summary.shaft_stopped);
}

TEST_CASE("an input torque that cannot carry the load makes the run INVALID", "[sequences]") {
  Run run;
  SECTION("it has the wrong sign") {
    run.rig.torque_sensor =
        std::make_unique<ScaledTorqueSensor>(std::move(run.rig.torque_sensor), -1);
    CHECK(run.go().points.at(0).status == "torque_implausible");
    CHECK(exit_code(run.summary.ending) == 20);
  }
  SECTION("it is a third of what the output asks for") {
    run.rig.torque_sensor =
        std::make_unique<ScaledTorqueSensor>(std::move(run.rig.torque_sensor), 1 / 3.0);
    CHECK(run.go().points.at(0).status == "torque_implausible");
  }
  SECTION("its sign turns in the last quarter of the record") {
    run.rig.torque_sensor =
        std::make_unique<ScaledTorqueSensor>(std::move(run.rig.torque_sensor), -1, 20);
    const auto& point = run.go().points.at(0);
    CHECK(point.status == "torque_implausible");
    CHECK(point.torque_Nm > 0);  // the mean of the whole shows nothing of it
  }
  SECTION("a reducer that loses a third of the power is no better than that") {
    run.rig.torque_sensor =
        std::make_unique<ScaledTorqueSensor>(std::move(run.rig.torque_sensor), 1.5);
    CHECK(run.go().points.at(0).status == "ok");
  }
}

TEST_CASE("lost samples make the run INVALID", "[sequences]") {
  Run run;
  run.world().schedule(MirrorFault::scans_lost, 12, 12.1);
  const auto& summary = run.go();
  CHECK(summary.points.at(0).status == "samples_lost");
  CHECK(exit_code(summary.ending) == 20);
}

TEST_CASE("a gap that nobody told makes the run INVALID", "[sequences]") {
  Run run;
  SECTION("a tenth of a second") {
    run.rig.accelerometers = std::make_unique<SwallowingAccelerometers>(
        std::move(run.rig.accelerometers), lost_from_s + 0.1);
    CHECK(run.go().points.at(0).status == "samples_lost");
    CHECK(exit_code(run.summary.ending) == 20);
  }
  SECTION("less than time stamps could tell") {
    run.rig.accelerometers = std::make_unique<SwallowingAccelerometers>(
        std::move(run.rig.accelerometers), lost_from_s + 0.02);
    CHECK(run.go().points.at(0).status == "ok");
  }
}

TEST_CASE("samples lost for some ticks on end keep their place in the record", "[sequences]") {
  Run run;
  SECTION("scans: the record is not ok") {
    run.rig.accelerometers =
        std::make_unique<LosingAccelerometers>(std::move(run.rig.accelerometers), lost_until_s);
    CHECK(run.go().points.at(0).status == "samples_lost");
    const auto& point = run.recording.points.at(0);
    CHECK(double(point.scans) ==
          Approx((point.accelerations_to_s - point.accelerations_from_s) * 4960).margin(0.5));
  }
  SECTION("torque and angle: so few do no harm") {
    run.rig.torque_sensor =
        std::make_unique<LosingTorqueSensor>(std::move(run.rig.torque_sensor), lost_until_s);
    CHECK(run.go().points.at(0).status == "ok");
    const auto& torque = run.recording.points.at(0).torque;
    const auto lost = std::count_if(torque.begin(), torque.end(), [](const auto& sample) {
      return std::isnan(sample.angle_rad);
    });
    CHECK((lost >= 50 && lost <= 70));  // ticks of 10 ms
    // 1815 rpm, sample by sample: the angle stands where its place in the record says.
    const double whole_rad = double(torque.size() - 1) / 1000 * 1815 * units::two_pi / 60;
    CHECK(torque.back().angle_rad - torque.front().angle_rad == Approx(whole_rad).margin(0.01));
  }
}

TEST_CASE("a device whose samples are all lost is lost as soon as the last good one is stale",
          "[sequences][safety]") {
  Run run;
  std::string device;
  SECTION("accelerometers") {
    device = "accelerometers";
    run.rig.accelerometers =
        std::make_unique<LosingAccelerometers>(std::move(run.rig.accelerometers), 1e9);
  }
  SECTION("torque sensor") {
    device = "torque sensor";
    run.rig.torque_sensor =
        std::make_unique<LosingTorqueSensor>(std::move(run.rig.torque_sensor), 1e9);
  }
  const auto& summary = run.go();
  CHECK(exit_code(summary.ending) == 30);
  CHECK_THAT(summary.ending.reason, Catch::Contains(device) && Catch::Contains("samples are lost"));
  CHECK(run.stopped_s() == Approx(lost_from_s + 0.3).margin(0.05));
}

TEST_CASE("a record that does not come by its turns is too short", "[sequences]") {
  Run run;
  const auto plan = test::plan_of(small_plan);
  sequences::BenchLoop loop(plan, run.rig, run.recording, run.observer, {}, 0);
  REQUIRE_FALSE(plan.setup[0]->run(loop, plan.specimen));
  REQUIRE_FALSE(loop.record_point(0, 100, 1.0));  // at standstill
  REQUIRE(loop.points().size() == 1);
  CHECK(loop.points()[0].status == "too_short");
  CHECK(run.recording.results.at(0).status == "too_short");
  const auto samples = run.recording.points.at(0).torque.size();
  CHECK((samples >= 999 && samples <= 1001));  // 1 s at 1 kHz, between two ticks
}

TEST_CASE("a recording that cannot be written ends the run", "[sequences]") {
  Run run;
  run.recording.fail_after = 100;
  const auto& summary = run.go();
  CHECK(exit_code(summary.ending) == 30);
  CHECK_THAT(summary.ending.reason, Catch::Contains("disk full"));
  CHECK(summary.shaft_stopped);
}

TEST_CASE("a last point that does not settle and cannot be written down is ERROR, not INVALID",
          "[sequences]") {
  Run run;
  run.world().schedule(MirrorFault::uneven_speed, 2);
  run.recording.fail_end_point = true;
  const auto& summary = run.go();
  CHECK(exit_code(summary.ending) == 30);
  CHECK_THAT(summary.ending.reason, Catch::Contains("disk full"));
  CHECK(summary.shaft_stopped);
}

namespace {

// Accelerometers of which a hole is told late, and then by the end of their stream.
class HoleToldLate final : public test::PassingAccelerometers {
 public:
  HoleToldLate(std::unique_ptr<hal::Accelerometers> real, const hal::Clock& clock, double told_s,
               double told_after_s = 2.5)
      : PassingAccelerometers(std::move(real)),
        clock_(clock),
        told_s_(told_s),
        told_after_s_(told_after_s) {}
  double hole_told_after_s() const override { return told_after_s_; }
  Result<hal::AccelerationBlock> read() override {
    if (clock_.now_s() >= told_s_) return IoError{IoErrc::overrun, "20 ms of samples are missing"};
    return behind_->read();
  }

 private:
  const hal::Clock& clock_;
  double told_s_, told_after_s_;
};

}  // namespace

TEST_CASE("a record that no scans follow long enough for a hole to be told is lost",
          "[sequences]") {
  Run run;
  run.rig.accelerometers = std::make_unique<HoleToldLate>(std::move(run.rig.accelerometers),
                                                          *run.rig.clock, 1e9, not_known);
  const auto plan = test::plan_of(small_plan);
  sequences::BenchLoop loop(plan, run.rig, run.recording, run.observer, {}, 0);
  REQUIRE_FALSE(plan.setup[0]->run(loop, plan.specimen));
  const auto ending = loop.record_point(0, 0, 1.0);  // no turns: it has them at once
  REQUIRE(ending);
  CHECK(ending->error_kind == ErrorKind::device_lost);
  CHECK_THAT(ending->reason, Catch::Contains("no scans followed the record"));
  CHECK(loop.points().at(0).status == "interrupted");
}

TEST_CASE("a record ends once a hole at its end would have been told", "[sequences]") {
  test::Run plain;
  plain.go();
  REQUIRE(plain.summary.points.at(0).status == "ok");
  const double end_s = plain.recording.points.at(0).accelerations_to_s;

  test::Run run;
  const double told_s = GENERATE_COPY(1e9, end_s + 0.1, end_s + 2.4);
  run.rig.accelerometers =
      std::make_unique<HoleToldLate>(std::move(run.rig.accelerometers), *run.rig.clock, told_s);
  run.go();
  // It is no longer for that.
  CHECK(run.recording.points.at(0).accelerations_to_s == Approx(end_s).margin(0.001));
  if (told_s > end_s + 2.5) {
    CHECK(run.summary.points.at(0).status == "ok");
    CHECK(run.summary.duration_s == Approx(plain.summary.duration_s + 2.5).margin(0.1));
    CHECK(run.observer.last_total_s == Approx(plain.observer.last_total_s + 2.5));
    CHECK(run.observer.last_done_s > plain.observer.last_total_s + 1.5);
  } else {
    CHECK(run.summary.points.at(0).status == "interrupted");
    CHECK(run.summary.ending.error_kind == ErrorKind::device_lost);
    CHECK_THAT(run.summary.ending.reason, Catch::Contains("20 ms of samples are missing"));
  }
}
