#include "tests/faults/fault_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "analysis/quality.hpp"
#include "hal/simulated_rig.hpp"
#include "sequences/sequencer.hpp"
#include "tests/faults/oracle.hpp"

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
  "main": [{"phase": "matrix", "speeds_rpm": [1815], "loads_pct": [100],
            "record": {"output_turns": 4}}],
  "teardown": {"standstill_timeout_s": 10}
})";

sequences::TestPlan campaign_plan() {
  auto read = sequences::parse_plan(hal::ConfigReader::from_text(plan_text, "faults.json"));
  if (read.index() == 1) throw std::logic_error(describe("faults.json", std::get<1>(read).front()));
  return std::get<0>(std::move(read));
}

// Keeps the accelerations, so that they are judged as those of a recording are.
class KeptRecording final : public hal::RecordingWriter {
 public:
  explicit KeptRecording(const std::vector<ChannelInfo>& channels) : channels_(channels) {}

  Status append(int, const hal::AccelerationBlock& block) override {
    if (disk_full) return IoError{IoErrc::refused, "No space left on device"};
    for (Eigen::Index i = 0; i < block.scans.size(); ++i) samples_.push_back(block.scans.data()[i]);
    return Done{};
  }
  Status append(int, const hal::TorqueBlock&) override {
    if (disk_full) return IoError{IoErrc::refused, "No space left on device"};
    return Done{};
  }
  Status end_point(const hal::PointResult&) override {
    if (disk_full) return IoError{IoErrc::refused, "No space left on device"};
    return Done{};
  }
  Status note(double, const std::string&) override { return Done{}; }
  Status close() override { return Done{}; }

  std::string first_flaw(const ChannelCheck& check) const {
    const auto count = Eigen::Index(channels_.size());
    const Eigen::Map<const hal::AccelerationBlock::Scans> scans(
        samples_.data(), Eigen::Index(samples_.size()) / count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Channel channel{channels_[std::size_t(i)], FaultBench::rate_Hz, 0,
                            scans.col(i).cast<double>()};
      for (const auto& note : check(channel, FaultBench::range_m_s2)) {
        if (note.invalidates) return channel.info.name + " is " + note.what;
      }
    }
    return "";
  }

  bool disk_full = false;

 private:
  const std::vector<ChannelInfo>& channels_;
  std::vector<float> samples_;
};

class Silence final : public sequences::RunObserver {
 public:
  void progress(double, double, const std::string&) override {}
  void event(double, const std::string&) override {}
};

double delay_s(BenchState state, std::uint64_t seed) {
  static const std::map<BenchState, double> lengths_s{
      {BenchState::connecting, 0}, {BenchState::arming, 0.05},  {BenchState::warming_up, 2.5},
      {BenchState::settling, 2},   {BenchState::recording, 12}, {BenchState::stopping, 2}};
  std::mt19937_64 random(seed);
  return std::uniform_real_distribution<double>(0, lengths_s.at(state))(random);
}

}  // namespace

FaultReport run_fault(const FaultCase& fault, const Guard* without) {
  sequences::TestPlan plan = campaign_plan();
  auto owned = std::make_unique<FaultBench>(
      fault.seed, fault.kind != nullptr ? fault.kind->drive : FaultKind{}.drive);
  FaultBench& bench = *owned;
  bench.server.set_lateness_s(1.5 * patience_s);
  hal::Rig rig = hal::make_simulated_rig(
      std::move(owned),
      {.response_timeout_s = response_timeout_s, .stall_s = patience_s - response_timeout_s});
  KeptRecording recording(bench.acceleration_channels());
  std::stop_source stop;
  FaultReport report;
  double struck_s = not_known;
  bool was_driven = false;
  Victim victim{bench, stop, recording.disk_full};
  if (fault.kind != nullptr) {
    bench.when(fault.state, delay_s(fault.state, fault.seed), [&] {
      report.struck = true;
      struck_s = bench.now_s();
      was_driven = bench.is_driven();
      fault.kind->strike(victim);
    });
  }
  ChannelCheck check = analysis::accelerometer_quality;
  Controller controller{plan, rig, check};
  if (without != nullptr) without->switch_off(controller);
  Silence silence;
  const auto summary = sequences::run_sequence(plan, rig, recording, silence, stop.get_token());
  Ending ending = summary.ending;
  if (const std::string flaw = recording.first_flaw(check);
      ending.outcome == Outcome::pass && !flaw.empty()) {
    ending = {Outcome::invalid, ErrorKind::none, flaw};
  }
  report.outcome = fmt::format("{}: {}", to_string(ending.outcome), ending.reason);
  Oracle oracle(fault, bench, report);
  oracle.after_return();
  bench.advance_to(bench.now_s() + alone_s);
  oracle.long_after();
  oracle.on_shaft_and_brake(struck_s, was_driven, plan.teardown.standstill_timeout_s);
  oracle.on_ending(ending);
  return report;
}

}  // namespace rvbench::test
