#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>
#include <stop_token>
#include <string>

#include "bench/acceptance.hpp"
#include "bench/judging.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "hal/simulated_rig.hpp"
#include "hal/types/units.hpp"
#include "sequences/plan.hpp"
#include "sim/bench_world.hpp"
#include "tests/support/plan_of.hpp"
#include "tests/support/replaced.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::test {

/// One point. Warm-up from 0.1 s of the rig's time on, the change of speed from 1.1 s, the record
/// from 2.7 s to 27 s.
inline const std::string short_plan = R"({
  "name": "short",
  "specimen": {"kinematics": "rv20e", "gear_ratio": 121, "rated_output_torque_Nm": 167},
  "interlocks": {"input_speed_rpm": 2200, "input_torque_Nm": 8, "acceleration_m_s2": 300,
                 "housing_temp_degC": 60, "stale_after_s": 0.3},
  "setup": [{"phase": "connect"},
            {"phase": "warm_up", "duration_s": 1, "speed_rpm": 605, "load_pct": 50}],
  "main": [{"phase": "matrix", "speeds_rpm": [1210], "loads_pct": [50],
            "settling": {"hold_s": 0.5}, "record": {"output_turns": 4}}]
})";

/// The same, with limits of races that its few output turns can be held against.
inline std::string short_plan_with_limits() {
  std::string limits;
  for (const char* part : {"inner", "outer", "ball"}) {
    limits += std::string(limits.empty() ? "" : ", ") +
              R"({"measure": "modulation_depth", "unit": "1", "component": "bearing_)" + part +
              R"(", "max": 0.3, "why": "four output turns hide less"})";
  }
  return replaced(short_plan, "\"setup\"", "\"limits\": [" + limits + "], \"setup\"");
}

/// The band is narrower than the motor's slip: the point is given up after 1.1 s.
inline std::string unsettled_plan() {
  return replaced(short_plan, "{\"hold_s\": 0.5}",
                  "{\"hold_s\": 0.5, \"timeout_s\": 1.1, \"speed_tolerance_pct\": 0.1}");
}

/// An acceptance run from plan to run folder, on the simulated bench over its real wires: Modbus
/// TCP, CAN frames. The world behind it can be made to misbehave and looked at afterwards.
class BenchRun {
 public:
  explicit BenchRun(const sim::InverterParameters& inverter = {},
                    const sim::PlantSpec& plant = sim::rv20e_bench()) {
    auto world = std::make_unique<sim::BenchWorld>(sim::draw_unit("healthy", 1), inverter, plant);
    world_ = world.get();
    const hal::SimulatedRigOptions options{.torque_rate_Hz = world->transducer().rate_Hz()};
    rig_ = hal::make_simulated_rig(std::move(world), options);
  }

  sim::BenchWorld& world() { return *world_; }
  std::stop_source& stop() { return stop_; }
  const std::filesystem::path& folder() const { return scratch_.path(); }
  void refuse(const Ending& refusal) { refusal_ = refusal; }

  const bench::Judgement& go(const std::string& plan_text = short_plan) {
    const sequences::TestPlan plan = plan_of(plan_text);
    bench::write_file(folder() / "plan.json", sequences::plan_to_json(plan));
    const auto kinematics = std::get<0>(bench::read_kinematics(plan.specimen.kinematics));
    std::ostringstream out;
    bench::Console console{out, out};
    bench::ProgressBar bar(console, bench::ProgressBar::Style::silent);
    bench::RunFacts facts;
    facts.serial = "A17";
    facts.plan = plan.name;
    bench::Acceptance acceptance{
        plan, bench::with_limits(bench::of_specimen(kinematics, plan.specimen), plan.limits),
        folder(), facts};
    acceptance.refusal = refusal_;
    judgement_ = bench::run_acceptance(std::move(acceptance), rig_, bar, stop_.get_token());
    return judgement_;
  }

  const bench::Judgement& judgement() const { return judgement_; }

  /// When the run's log first says `text`; NaN if never.
  double told_s(const std::string& text) const {
    for (const auto& [time_s, event] : judgement_.facts.events) {
      if (event.find(text) != std::string::npos) return time_s;
    }
    return not_known;
  }

  double shaft_rpm() const {
    return std::abs(units::rpm_from_rad_s(world_->plant().motor_speed_rad_s()));
  }

 private:
  ScratchFolder scratch_;
  std::stop_source stop_;
  std::optional<Ending> refusal_;
  sim::BenchWorld* world_ = nullptr;
  hal::Rig rig_;
  bench::Judgement judgement_;
};

/// What must hold after every run, however it ended: in the plant itself, not by what is reported.
inline void check_at_rest(BenchRun& run) {
  CHECK(run.shaft_rpm() < 1);
  CHECK_FALSE(run.world().inverter().output_enabled());
  CHECK_FALSE(run.world().brake().engaged());
  // Nothing resumes by itself, not even when the wire is well again.
  run.world().inverter_server().inject({});
  run.world().advance_to(run.world().now_s() + 2);
  CHECK(run.shaft_rpm() < 1);
  CHECK_FALSE(run.world().inverter().output_enabled());
}

/// The run folder tells how the run ended, in each of its files.
inline void check_told(const BenchRun& run, const std::string& verdict, const std::string& reason) {
  CHECK_THAT(run.judgement().ending.reason, Catch::Contains(reason));
  for (const char* name : {"verdict.json", "log.jsonl", "junit.xml", "report.html"}) {
    CAPTURE(name);
    const std::string text = bench::read_file(run.folder() / name).value_or("");
    CHECK((text.find(reason) != std::string::npos));  // not printed: a report is long
    CHECK((text.find(verdict) != std::string::npos));
  }
  CHECK(bench::verify_sums(run.folder()).empty());
}

}  // namespace rvbench::test
