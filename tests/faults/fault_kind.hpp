#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "tests/faults/fault_bench.hpp"

namespace rvbench::test {

/// What a controller worth its name makes of a fault that strikes before the last point is over.
enum class Answer {
  pass,         ///< a passing hiccup: no false alarm
  no_pass,      ///< the data are spoilt, or the bench is at fault
  device_lost,  ///< ERROR, exit 30
  safety_trip,  ///< ERROR, exit 40
  aborted       ///< exit 50
};

/// When a fault shows to a controller that looks for it: from then on its time is counted.
enum class Shown {
  at_once,
  at_next_speed,   ///< what does not follow is told from what stands still; else at the stop
  in_next_record,  ///< when the next sample is written
  at_stop          ///< when the drive is told to stop
};

/// What a fault may take hold of.
struct Victim {
  FaultBench& bench;
  std::stop_source& stop;  ///< what Ctrl-C requests
  bool& disk_full;         ///< the recording can be written no more
  std::uint64_t seed;      ///< of the case, for a choice among variants
  std::function<void()> kill_controller;
};

struct FaultKind {
  std::string name;
  std::function<void(Victim&)> strike;
  Answer answer = Answer::no_pass;
  std::string words = "";         ///< that the reason must hold; "" = any
  double stopped_within_s = 1e9;  ///< from then to nobody driving the shaft, where it drives
  bool cuts_brake_off = false;    ///< no command reaches the brake: its own watchdog releases it
  bool hides_standstill = false;  ///< devices contradict each other: teardown waits in vain
  sim::InverterParameters drive{.comm_loss_timeout_s = 0.5};
  bool holds_from_start = false;  ///< the answer is asked for whenever it strikes, if at all
  bool kills_controller = false;  ///< no ending is to be judged, for nobody tells one
  std::function<bool(BenchState)> is_harmless_when = {};  ///< when it spoils nothing
  Shown shown = Shown::at_once;
};

/// Until nobody drives the shaft any more: by the plan's staleness of 0.3 s, the drive's watchdog
/// of 0.5 s and a response time-out of 0.05 s.
namespace within {
inline constexpr double trip_s = 0.025;          // a tick of 10 ms, and one more for the command
inline constexpr double stale_s = 0.3 + trip_s;  // however long a device hands out its last word
// Staleness, a call under way (four response time-outs), a tick, then silence until the watchdog
// acts, in the plant's next step.
inline constexpr double link_dead_s = 0.3 + 4 * 0.05 + 0.01 + 0.5 + 0.01;
inline constexpr double watchdog_s = 0.5 + 0.01;
// The angle's speed is taken over 0.1 s, the drive is asked every 0.05 s, and it takes a second of
// contradiction: by more than 60 rpm and 15 % of the angle's speed.
inline constexpr double contradicted_s = 0.1 + 0.05 + 1 + trip_s;
// A stop in vain is repeated after a second, or rather left to the watchdog; ticks of both.
inline constexpr double disobeyed_s = 1 + 0.02 + watchdog_s;
inline constexpr double at_plants_step_s = 0.01;
// By the ramp of 20 Hz/s, with the rotor's lag: from standstill to 60 rpm, and from one speed of
// the plan to where the next one contradicts it, 9.4 Hz at most.
inline constexpr double ramp_from_rest_s = 0.2;
inline constexpr double ramp_apart_s = 0.6;
}  // namespace within

/// One that does it to the bench.
FaultKind on_bench(std::string name, std::function<void(FaultBench&)> what, Answer answer,
                   std::string words = "", double stopped_within_s = 1e9);
FaultKind disturbed(std::string name, bool Disturbance::*what, Answer answer,
                    std::string words = "", double stopped_within_s = 1e9);

/// Every kind, by name.
const std::vector<FaultKind>& fault_kinds();

/// In groups, by what they strike.
std::vector<FaultKind> faults_of_the_drive();
std::vector<FaultKind> faults_of_the_bus();
std::vector<FaultKind> faults_of_the_daq();
std::vector<FaultKind> faults_of_the_hall();

}  // namespace rvbench::test
