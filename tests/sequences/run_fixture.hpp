#pragma once

#include <catch2/catch.hpp>
#include <map>
#include <string>
#include <vector>

#include "hal/mirror_rig.hpp"
#include "sequences/plan.hpp"
#include "sequences/sequencer.hpp"
#include "tests/support/plan_of.hpp"

namespace rvbench::test {

/// Keeps in memory what a run records.
class MemoryRecording final : public hal::RecordingWriter {
 public:
  struct Point {
    long scans = 0;
    double accelerations_from_s = not_known, accelerations_to_s = not_known;
    std::vector<hal::TorqueSample> torque;
    double torque_from_s = not_known;
  };

  Status append(int point, const hal::AccelerationBlock& block) override {
    if (fail_after-- <= 0) return IoError{IoErrc::refused, "disk full"};
    Point& p = points[point];
    if (p.scans == 0) p.accelerations_from_s = block.t0_s;
    p.scans += block.scans.rows();
    p.accelerations_to_s = block.t0_s + double(block.scans.rows()) / 4960;
    return Done{};
  }
  Status append(int point, const hal::TorqueBlock& block) override {
    Point& p = points[point];
    if (p.torque.empty()) p.torque_from_s = block.t0_s;
    p.torque.insert(p.torque.end(), block.samples.begin(), block.samples.end());
    return Done{};
  }
  Status end_point(const hal::PointResult& result) override {
    if (fail_end_point) return IoError{IoErrc::refused, "disk full"};
    results.push_back(result);
    return Done{};
  }
  Status note(double time_s, const std::string& event) override {
    notes.emplace_back(time_s, event);
    return Done{};
  }
  Status close() override { return Done{}; }

  std::map<int, Point> points;
  std::vector<hal::PointResult> results;
  std::vector<std::pair<double, std::string>> notes;
  long fail_after = 1000000000;  ///< blocks
  bool fail_end_point = false;
};

class MemoryObserver final : public sequences::RunObserver {
 public:
  void progress(double done_s, double total_s, const std::string& doing) override {
    CHECK(done_s <= total_s + 1e-6);
    CHECK(done_s >= last_done_s);
    last_done_s = done_s;
    last_total_s = total_s;
    doings[doing]++;
  }
  void event(double, const std::string& text) override {
    const bool stopped = world != nullptr && !world->speed_commands().empty() &&
                         world->speed_commands().back().second == 0;
    events.emplace_back(stopped, text);
  }

  double last_done_s = 0, last_total_s = 0;
  std::map<std::string, int> doings;
  const hal::MirrorWorld* world = nullptr;
  std::vector<std::pair<bool, std::string>> events;  ///< was the drive told to stop by then?
};

/// Remembers what it is told.
class EventTexts final : public sequences::RunObserver {
 public:
  void progress(double, double, const std::string&) override {}
  void event(double, const std::string& text) override { texts.push_back(text); }

  std::vector<std::string> texts;
};

/// On the live rig about four seconds in all.
inline const std::string live_plan = R"({
  "name": "short",
  "specimen": {"kinematics": "rv20e", "gear_ratio": 1.5, "rated_output_torque_Nm": 1},
  "interlocks": {"input_speed_rpm": 2200, "input_torque_Nm": 8, "acceleration_m_s2": 300,
                 "housing_temp_degC": 60, "stale_after_s": 1},
  "setup": [{"phase": "connect"},
            {"phase": "warm_up", "duration_s": 0.1, "speed_rpm": 605, "load_pct": 50}],
  "main": [{"phase": "matrix", "speeds_rpm": [1815], "loads_pct": [100],
            "settling": {"hold_s": 0.5, "timeout_s": 10}, "record": {"output_turns": 40}}],
  "teardown": {"standstill_timeout_s": 5}
})";

/// One point after two seconds of warm-up: about 25 s of rig time at 1815 rpm.
inline const std::string small_plan = R"({
  "name": "small",
  "specimen": {"kinematics": "rv20e", "gear_ratio": 121, "rated_output_torque_Nm": 167},
  "interlocks": {"input_speed_rpm": 2200, "input_torque_Nm": 8, "acceleration_m_s2": 300,
                 "housing_temp_degC": 60, "stale_after_s": 0.3},
  "setup": [{"phase": "connect"},
            {"phase": "warm_up", "duration_s": 2, "speed_rpm": 605, "load_pct": 50}],
  "main": [{"phase": "matrix", "speeds_rpm": [1815], "loads_pct": [100],
            "record": {"output_turns": 4}}]
})";

/// What is wrong with a plan, a line each, as it is told.
inline std::string faults_of(const std::string& plan_text) {
  const auto read = sequences::parse_plan(hal::ConfigReader::from_text(plan_text, "plan.json"));
  std::string all;
  if (const auto* faults = std::get_if<std::vector<hal::ConfigFault>>(&read)) {
    for (const auto& fault : *faults) all += describe("plan.json", fault) + '\n';
  }
  return all;
}

/// A run on the mirror rig, with all that can be seen of it.
struct Run {
  explicit Run(const hal::MirrorOptions& options = {}) : rig(hal::make_mirror_rig(options)) {
    observer.world = &world();
  }

  const sequences::RunSummary& go(const std::string& plan_text = small_plan, int first_point = 0) {
    const auto plan = plan_of(plan_text);
    summary =
        sequences::run_sequence(plan, rig, recording, observer, stop.get_token(), first_point);
    return summary;
  }
  hal::MirrorWorld& world() { return hal::mirror_world(rig); }

  /// When the drive was first told to turn; NaN if it was not.
  double started_s() {
    for (const auto& [time_s, speed_rpm] : world().speed_commands()) {
      if (speed_rpm != 0) return time_s;
    }
    return not_known;
  }

  /// When the drive was first told to stop for good; NaN if it was not.
  double stopped_s() {
    double since_s = not_known;
    for (const auto& [time_s, speed_rpm] : world().speed_commands()) {
      if (speed_rpm != 0) since_s = not_known;
      if (speed_rpm == 0 && std::isnan(since_s)) since_s = time_s;
    }
    return since_s;
  }

  hal::Rig rig;
  MemoryRecording recording;
  MemoryObserver observer;
  std::stop_source stop;
  sequences::RunSummary summary;
};

}  // namespace rvbench::test
