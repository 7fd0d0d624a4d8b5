#include "tests/faults/scene.hpp"

#include <fmt/format.h>

#include <map>

#include "hal/simulated_rig.hpp"
#include "sequences/silent_observer.hpp"
#include "tests/faults/oracle.hpp"
#include "tests/faults/undrained_drive.hpp"
#include "tests/support/plan_of.hpp"

namespace rvbench::test {
namespace {

constexpr double response_timeout_s = 0.05;
constexpr double patience_s = 0.25;  // real time: a busy computer is no dead drive
constexpr double alone_s = 6;        // watchdog and ramp are over by then

const std::string plan_text = R"({
  "name": "faults", "acceleration_rate_Hz": 1240,
  "specimen": {"kinematics": "rv20e", "gear_ratio": 121, "rated_output_torque_Nm": 167},
  "interlocks": {"input_speed_rpm": 2200, "input_torque_Nm": 8, "acceleration_m_s2": 300,
                 "housing_temp_degC": 60, "stale_after_s": 0.3},
  "setup": [{"phase": "connect"},
            {"phase": "warm_up", "duration_s": 3, "speed_rpm": 605, "load_pct": 50}],
  "main": [{"phase": "matrix", "speeds_rpm": [1210], "loads_pct": [50],
            "record": {"output_turns": 4}},
           {"phase": "matrix", "speeds_rpm": [1815], "loads_pct": [100],
            "record": {"output_turns": 4}}],
  "teardown": {"standstill_timeout_s": 10}
})";

// Within that time of a state being entered; a record goes on for two seconds after it, so that
// there is something to be seen of the fault.
double delay_s(BenchState state, std::uint64_t seed) {
  static const std::map<BenchState, double> lengths_s{
      {BenchState::connecting, 0},       {BenchState::arming, 0.05},
      {BenchState::warming_up, 2.5},     {BenchState::settling, 2},
      {BenchState::recording, 18},       {BenchState::settling_again, 2},
      {BenchState::recording_again, 11}, {BenchState::stopping, 2}};
  std::mt19937_64 random(seed);
  return std::uniform_real_distribution<double>(0, lengths_s.at(state))(random);
}

hal::RecordingLayout layout_of(const sequences::TestPlan& plan, const FaultBench& bench) {
  return {.points = plan.points(),
          .acceleration_channels = bench.acceleration_channels(),
          .acceleration_rate_Hz = FaultBench::rate_Hz,
          .acceleration_range_m_s2 = FaultBench::range_m_s2,
          .torque_rate_Hz = bench.transducer.rate_Hz(),
          .software = "rvbench_faults"};
}

}  // namespace

Scene::Scene(const FaultCase& fault, const std::filesystem::path& recording, const Guard* without,
             std::function<void(Scene&)> on_kill)
    : fault_(fault),
      file_(recording),
      on_kill_(std::move(on_kill)),
      plan_(plan_of(plan_text)),
      check_(flaw_of_record),
      owned_(std::make_unique<FaultBench>(
          fault.seed, fault.kind != nullptr ? fault.kind->drive : FaultKind{}.drive)),
      bench_(*owned_) {
  recording_ = std::make_unique<KeptRecording>(file_, layout_of(plan_, bench_));
  bench_.server.set_lateness_s(1.5 * patience_s);
  rig_ = hal::make_simulated_rig(std::move(owned_), {.response_timeout_s = response_timeout_s,
                                                     .stall_s = patience_s - response_timeout_s});
  auto witnessed = std::make_unique<WitnessedDrive>(
      std::move(rig_.drive), bench_.inverter, bench_.server, *rig_.clock, patience_s, witness_);
  WitnessedDrive& drive = *witnessed;
  rig_.drive = std::move(witnessed);
  Controller controller{plan_, rig_, check_, *recording_, [this, &drive] {
                          drive.replace_driver(make_undrained_drive(
                              bench_.server.port(), *rig_.clock, response_timeout_s, patience_s));
                        }};
  if (without != nullptr) without->switch_off(controller);
  if (fault_.kind == nullptr) return;
  bench_.when(fault_.state, delay_s(fault_.state, fault_.seed), [this] { strike(); });
}

void Scene::strike() {
  report_.struck = true;
  struck_s_ = bench_.now_s();
  was_driven_ = bench_.is_driven();
  Victim victim{bench_, stop_, recording_->disk_full, fault_.seed, [this] { on_kill_(*this); }};
  fault_.kind->strike(victim);
}

Ending Scene::measure() {
  sequences::SilentObserver nobody;
  const auto summary = sequences::run_sequence(plan_, rig_, *recording_, nobody, stop_.get_token());
  Oracle(fault_, bench_, report_).after_return();
  return summary.ending;
}

void Scene::leave_alone() { bench_.advance_to(bench_.now_s() + alone_s); }

void Scene::judge_plant() {
  Oracle oracle(fault_, bench_, report_);
  report_.held_up = witness_.held_up;
  if (witness_.belated_readings > 0) {
    oracle.blame(
        fmt::format("{} late replies were taken for the next ones", witness_.belated_readings));
  }
  oracle.long_after();
  oracle.on_shaft_and_brake(struck_s_, was_driven_, witness_.stop_asked_s,
                            plan_.teardown.standstill_timeout_s);
}

// What is on the disk, and then what is said of the whole.
void Scene::judge_recording(Ending& ending) {
  Oracle oracle(fault_, bench_, report_);
  const Status closed = recording_->close();
  if (!closed) oracle.blame("the recording cannot be closed: " + describe(closed.error()));
  const ReadBack found = read_back(file_, recording_->acknowledged(), bench_.truth, check_);
  for (const std::string& loss : found.losses) oracle.blame(loss);
  if (ending.outcome == Outcome::pass && !found.flaw.empty()) {
    ending = {Outcome::invalid, ErrorKind::none, found.flaw};
  }
  report_.outcome = fmt::format("{}: {}", to_string(ending.outcome), ending.reason);
  oracle.on_ending(ending);
}

}  // namespace rvbench::test
