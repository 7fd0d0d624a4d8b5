#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "tests/sequences/run_fixture.hpp"
#include "tests/support/passing_devices.hpp"

using namespace rvbench;
using hal::MirrorFault;
using test::Run;
using test::small_plan;

namespace {

// A phase whose timeline cannot even be asked for.
class Defective final : public sequences::Phase {
 public:
  std::string_view kind() const override { return "defective"; }
  std::string to_json() const override { return "{}"; }
  std::vector<sequences::Segment> timeline(const sequences::Specimen&) const override {
    throw std::logic_error("a defect of the phase");
  }
  std::optional<Ending> run(sequences::BenchLoop&, const sequences::Specimen&) override {
    return std::nullopt;
  }
};

// A brake that drags though it is released, as powder brakes do.
class DraggingBrake final : public test::PassingBrake {
 public:
  DraggingBrake(std::unique_ptr<hal::Brake> brake, hal::BrakeLimits limits, double drag_Nm)
      : PassingBrake(std::move(brake)), limits_(limits), drag_Nm_(drag_Nm) {}
  hal::BrakeLimits limits() const override { return limits_; }

 protected:
  void show(hal::BrakeStatus& status) override {
    status = {std::fmax(drag_Nm_, status.torque_Nm), status.tripped};
  }

 private:
  hal::BrakeLimits limits_;
  double drag_Nm_;
};

// A log whose disk is full when the worst is to be told.
class TongueTied final : public sequences::RunObserver {
 public:
  void progress(double, double, const std::string&) override {}
  void event(double, const std::string& text) override {
    if (text.find("emergency stop") != std::string::npos) throw std::runtime_error("disk full");
  }
};

// A brake that cannot be told anything from the end of the run on. At standstill it holds nothing.
class DeafBrake final : public test::PassingBrake {
 public:
  using PassingBrake::PassingBrake;
  Status release() noexcept override {
    is_deaf_ = true;
    return IoError{IoErrc::disconnected, "CAN can0"};
  }

 protected:
  void show(hal::BrakeStatus& status) override {
    if (is_deaf_) status = {.torque_Nm = 0};
  }

 private:
  bool is_deaf_ = false;
};

}  // namespace

TEST_CASE("a brake that could not be told is not seen released, though it holds nothing",
          "[sequences][safety]") {
  Run run;
  run.rig.brake = std::make_unique<DeafBrake>(std::move(run.rig.brake));
  const auto& summary = run.go();
  CHECK_FALSE(summary.brake_released);
  CHECK(exit_code(summary.ending) == 30);
  CHECK_THAT(summary.ending.reason, Catch::Contains("does not confirm that it has released"));
}

TEST_CASE("the brake is released at standstill, not before", "[sequences]") {
  Run run;
  run.go();
  // From 1815 rpm at 500 rpm/s the ramp takes 3.63 s; standstill must then last 0.3 s.
  const double stopped_s = run.stopped_s();
  CHECK(run.world().brake_released_s() - stopped_s > 3.63);
  CHECK(run.world().brake_released_s() - stopped_s < 3.63 + 1.0);
}

TEST_CASE("a brake counts as released that shows no more than its residual torque", "[sequences]") {
  const auto released = [](hal::BrakeLimits limits) {
    Run run;
    run.rig.brake = std::make_unique<DraggingBrake>(std::move(run.rig.brake), limits, 12);
    return run.go().brake_released;
  };
  CHECK_FALSE(released({.max_torque_Nm = 400}));  // 2 % of it are 8 N·m
  CHECK(released({.max_torque_Nm = 400, .residual_torque_pct = 4}));
}

TEST_CASE("an exception inside a phase ends in teardown", "[sequences][safety]") {
  Run run;
  run.world().schedule(MirrorFault::drive_throws, 12, 12.1);
  const auto& summary = run.go();
  CHECK(summary.ending.outcome == Outcome::error);
  CHECK_THAT(summary.ending.reason, Catch::Contains("a defect of the driver"));
  CHECK(run.stopped_s() == Approx(12).margin(0.1));
  CHECK(run.world().speed_rpm() == 0);
  CHECK(run.world().brake_torque_Nm() == 0);
  CHECK(summary.brake_released);
  CHECK(summary.points.at(0).status == "interrupted");
}

TEST_CASE("a setup that fails is torn down all the same", "[sequences][safety]") {
  SECTION("devices that do not answer are all named") {
    Run run;
    run.world().schedule(MirrorFault::brake_dead, 0);
    run.world().schedule(MirrorFault::safety_dead, 0);
    const auto& summary = run.go();
    CHECK(summary.ending.error_kind == ErrorKind::device_lost);
    CHECK_THAT(summary.ending.reason, Catch::Contains("brake"));
    CHECK_THAT(summary.ending.reason, Catch::Contains("safety"));
    CHECK(summary.shaft_stopped);
    CHECK_FALSE(std::isnan(run.stopped_s()));
  }
  SECTION("a drive without a safe watchdog is not armed") {
    const auto watchdog = GENERATE(hal::DriveWatchdog{0, true}, hal::DriveWatchdog{1, false},
                                   hal::DriveWatchdog{2.5, true});
    Run run({.watchdog = watchdog});
    const auto& summary = run.go();
    CHECK(exit_code(summary.ending) == 30);
    CHECK_THAT(summary.ending.reason, Catch::Contains("refused to arm"));
    for (const auto& [time_s, speed_rpm] : run.world().speed_commands()) CHECK(speed_rpm == 0);
    CHECK(summary.shaft_stopped);
  }
}

TEST_CASE("a plan beyond the rig is refused before anything turns, without a wait",
          "[sequences][safety]") {
  const auto [options, reason] = GENERATE(values<std::pair<hal::MirrorOptions, std::string>>({
      {{.max_speed_rpm = 1500}, "the plan asks for 1815 rpm, the drive can do 1500 rpm"},
      {{.max_brake_torque_Nm = 100}, "the plan asks for 167 N·m, the brake can do 100 N·m"},
      {{.acceleration_rate_Hz = 2000},
       "the accelerometers run at 2000 Hz, the plan asks for 4960 Hz"},
      {{.acceleration_range_m_s2 = 300},
       "the acceleration interlock of 300 m/s² could never trip: the accelerometers show no more "
       "than 300 m/s²"},
  }));
  Run run(options);
  const auto& summary = run.go();
  CHECK(exit_code(summary.ending) == 30);
  CHECK(summary.ending.reason == reason);
  for (const auto& [time_s, speed_rpm] : run.world().speed_commands()) CHECK(speed_rpm == 0);
  CHECK(summary.shaft_stopped);  // and it was seen to be
  CHECK(summary.brake_released);
  CHECK(summary.duration_s < 1);
}

TEST_CASE("a defect in a phase's own timeline is an ERROR, with the bench told to stop",
          "[sequences][safety]") {
  Run run;
  sequences::TestPlan plan = test::plan_of(small_plan);
  plan.main.push_back(std::make_unique<Defective>());
  REQUIRE(run.rig.drive->connect());
  REQUIRE(run.rig.brake->connect());
  REQUIRE(run.rig.drive->set_speed(605));  // as if left over from another program
  REQUIRE(run.rig.brake->set_torque(50));
  const auto summary =
      sequences::run_sequence(plan, run.rig, run.recording, run.observer, run.stop.get_token());
  CHECK(exit_code(summary.ending) == 30);
  CHECK(summary.ending.reason == "internal error: a defect of the phase");
  CHECK(run.world().speed_commands().back().second == 0);
  CHECK(run.world().brake_torque_Nm() == 0);
  CHECK_FALSE(summary.shaft_stopped);  // nobody looked
  CHECK(summary.points.empty());
}

TEST_CASE("a trip that cannot be told is a trip all the same", "[sequences][safety]") {
  Run run;
  run.world().schedule(MirrorFault::estop, 5);
  TongueTied observer;
  const auto summary = sequences::run_sequence(test::plan_of(small_plan), run.rig, run.recording,
                                               observer, run.stop.get_token());
  CHECK(exit_code(summary.ending) == 40);
  CHECK(run.stopped_s() == Approx(5).margin(0.02));
  CHECK(summary.shaft_stopped);
  CHECK(summary.brake_released);
}

TEST_CASE("with everything dead the teardown still ends, at its time-out", "[sequences][safety]") {
  Run run;
  for (const auto fault :
       {MirrorFault::drive_dead, MirrorFault::brake_dead, MirrorFault::torque_sensor_dead,
        MirrorFault::safety_dead, MirrorFault::accelerometers_dead}) {
    run.world().schedule(fault, 12);
  }
  const auto& summary = run.go();
  CHECK(exit_code(summary.ending) == 30);
  CHECK_FALSE(summary.shaft_stopped);  // nobody saw it
  CHECK_FALSE(summary.brake_released);
  run.world().advance();
  CHECK(run.world().speed_rpm() == 0);  // but the watchdogs did it
  CHECK(run.world().brake_torque_Nm() == 0);
  CHECK(run.rig.clock->now_s() > 12 + 30);
  CHECK(run.rig.clock->now_s() < 12 + 30 + 5);
}

TEST_CASE("without standstill the brake is released at the time-out", "[sequences][safety]") {
  Run run({.ramp_rpm_s = 40});  // at 800 rpm when it is pressed: 20 s to standstill
  run.world().schedule(MirrorFault::estop, 20);
  auto text = small_plan;
  text.insert(text.rfind('}'), R"(, "teardown": {"standstill_timeout_s": 10})");
  const auto& summary = run.go(text);
  CHECK(exit_code(summary.ending) == 40);
  CHECK_FALSE(summary.shaft_stopped);
  CHECK(summary.brake_released);
  CHECK(run.world().brake_released_s() - run.stopped_s() == Approx(10).margin(0.2));
}

TEST_CASE("whether a run came to rest is read off its events", "[sequences][safety]") {
  using sequences::tell_of_rest;
  const std::pair<double, std::string> begun{1, "armed"},
      passed{9, "measured: everything was measured; shaft at standstill, brake released"},
      aborted{9, "ABORTED: stopped by the operator; shaft at standstill, brake released"},
      tripped{9, "ERROR: torque 20 N·m; shaft at standstill, brake released"},
      unseen{9, "measured: everything was measured; shaft not seen at standstill, brake released"},
      later{10, "supervisor: 7 rounds"};
  CHECK(tell_of_rest({begun, passed}));
  CHECK(tell_of_rest({begun, aborted, later}));
  CHECK(tell_of_rest({begun, tripped, begun, passed}));
  CHECK_FALSE(tell_of_rest({begun, tripped}));
  CHECK_FALSE(tell_of_rest({begun, unseen}));
  CHECK_FALSE(tell_of_rest({begun, passed, begun}));  // killed in its second part
  CHECK_FALSE(tell_of_rest({}));
}
