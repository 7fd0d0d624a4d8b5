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

namespace rvbench::test {
namespace {

constexpr double release_limit_s = 0.2;
constexpr double standstill_seen_s = 0.6;  // 0.2 s of angle below 5 rpm, 0.3 s of lasting, ticks
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

  std::string first_flaw() const {
    const auto count = Eigen::Index(channels_.size());
    const Eigen::Map<const hal::AccelerationBlock::Scans> scans(
        samples_.data(), Eigen::Index(samples_.size()) / count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Channel channel{channels_[std::size_t(i)], FaultBench::rate_Hz, 0,
                            scans.col(i).cast<double>()};
      for (const auto& note : analysis::accelerometer_quality(channel, FaultBench::range_m_s2)) {
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

bool is_answered(Answer asked, const Ending& ending) {
  switch (asked) {
    case Answer::pass: return ending.outcome == Outcome::pass;
    case Answer::no_pass: return ending.outcome != Outcome::pass;
    case Answer::device_lost: return ending.error_kind == ErrorKind::device_lost;
    case Answer::safety_trip: return ending.error_kind == ErrorKind::safety_trip;
    case Answer::aborted: return ending.outcome == Outcome::aborted;
  }
  return false;
}

// What the plant shows, asked when the controller has returned and once more long after.
class Oracle {
 public:
  Oracle(const FaultBench& bench, FaultReport& report) : bench_(bench), report_(report) {}

  void after_return() {
    if (bench_.was(BenchState::warming_up) && bench_.brake_Nm() > 0 && !brake_link_is_dead) {
      blame("the brake still holds when the run has ended");
    }
  }

  void long_after() {
    if (std::abs(bench_.speed_rpm()) > 1) blame("the shaft turns for ever");
    if (bench_.is_driven()) blame("the shaft is driven after the end");
    if (bench_.brake_Nm() > 0) blame("the brake holds for ever");
  }

  void stopped(const FaultKind& kind, double struck_s, bool was_driven) {
    if (!was_driven) return;
    report_.undriven_s = bench_.driven_until_s() - struck_s;
    if (report_.undriven_s > kind.stopped_within_s) {
      blame(fmt::format("nobody stopped driving the shaft for {:.3f} s, {:.3f} s is the limit",
                        report_.undriven_s, kind.stopped_within_s));
    }
  }

  void released(double standstill_timeout_s) {
    if (brake_link_is_dead || bench_.braked_until_s() == 0 || bench_.driven_until_s() == 0) return;
    const double given_up_s = bench_.driven_until_s() + standstill_timeout_s;
    const double seen_s = bench_.moved_until_s() + standstill_seen_s;
    report_.released_s = bench_.braked_until_s() -
                         (standstill_is_hidden ? given_up_s : std::min(seen_s, given_up_s));
    if (report_.released_s > release_limit_s) {
      blame(
          fmt::format("the brake held {:.3f} s after standstill could be seen, {:.1f} s is the "
                      "limit",
                      report_.released_s, release_limit_s));
    }
  }

  bool brake_link_is_dead = false;
  bool standstill_is_hidden = false;

  void blame(std::string violation) { report_.violations.push_back(std::move(violation)); }

 private:
  const FaultBench& bench_;
  FaultReport& report_;
};

double delay_s(BenchState state, std::uint64_t seed) {
  static const std::map<BenchState, double> lengths_s{
      {BenchState::connecting, 0}, {BenchState::arming, 0.05},  {BenchState::warming_up, 2.5},
      {BenchState::settling, 2},   {BenchState::recording, 12}, {BenchState::stopping, 2}};
  std::mt19937_64 random(seed);
  return std::uniform_real_distribution<double>(0, lengths_s.at(state))(random);
}

// A trip left from before is reset at connect, a hiccup there may refuse the connection, and in
// virtual time a temperature may never have been known.
bool matters_at_connect(const FaultKind& kind) {
  constexpr std::array forgiven{"drive trips", "brake trips", "spike", "controller stalls",
                                "temperature sensor lost"};
  return kind.answer != Answer::pass && std::ranges::find(forgiven, kind.name) == forgiven.end();
}

// The verdict that a fault calls for, if it came while it still mattered.
void judge_ending(const FaultCase& fault, const Ending& ending, Oracle& oracle) {
  const FaultKind& kind = *fault.kind;
  const bool is_over = fault.state == BenchState::stopping;
  if (is_over || (fault.state == BenchState::connecting && !matters_at_connect(kind))) return;
  if (fault.state == BenchState::recording && kind.name == "drive deaf") return;  // told no more
  if (!is_answered(kind.answer, ending)) {
    oracle.blame(fmt::format("the run ended {} ({}): {}", to_string(ending.outcome),
                             to_string(ending.error_kind), ending.reason));
  } else if (ending.reason.find(kind.words) == std::string::npos &&
             !ending.reason.starts_with("not every device answers: ")) {
    oracle.blame("the reason does not name \"" + kind.words + "\": " + ending.reason);
  }
}

}  // namespace

FaultReport run_fault(const FaultCase& fault, const Guard* without) {
  sequences::TestPlan plan = campaign_plan();
  auto owned =
      std::make_unique<FaultBench>(fault.seed, sim::InverterParameters{.comm_loss_timeout_s = 0.5});
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
  if (without != nullptr) without->switch_off(plan, rig);
  Silence silence;
  const auto summary = sequences::run_sequence(plan, rig, recording, silence, stop.get_token());
  Ending ending = summary.ending;
  if (const std::string flaw = recording.first_flaw();
      ending.outcome == Outcome::pass && !flaw.empty()) {
    ending = {Outcome::invalid, ErrorKind::none, flaw};
  }
  report.outcome = fmt::format("{}: {}", to_string(ending.outcome), ending.reason);
  Oracle oracle(bench, report);
  if (fault.kind != nullptr) {
    oracle.brake_link_is_dead = fault.kind->cuts_brake_off;
    oracle.standstill_is_hidden = fault.kind->hides_standstill;
  }
  oracle.after_return();
  bench.advance_to(bench.now_s() + alone_s);
  oracle.long_after();
  if (fault.kind == nullptr) {
    if (ending.outcome != Outcome::pass) oracle.blame("a sound bench: " + report.outcome);
  } else if (report.struck) {
    oracle.stopped(*fault.kind, struck_s, was_driven);
    judge_ending(fault, ending, oracle);
  }
  oracle.released(plan.teardown.standstill_timeout_s);
  return report;
}

}  // namespace rvbench::test
