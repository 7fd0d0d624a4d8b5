#pragma once

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

/// What a fault may take hold of.
struct Victim {
  FaultBench& bench;
  std::stop_source& stop;  ///< what Ctrl-C requests
  bool& disk_full;         ///< the recording can be written no more
};

struct FaultKind {
  std::string name;
  std::function<void(Victim&)> strike;
  Answer answer = Answer::no_pass;
  std::string words;              ///< that the reason must hold; "" = any
  double stopped_within_s = 1e9;  ///< from the fault to nobody driving the shaft, where it drives
  bool cuts_brake_off = false;    ///< no command reaches the brake: its own watchdog releases it
  bool hides_standstill = false;  ///< devices contradict each other: teardown waits in vain
  sim::InverterParameters drive{.comm_loss_timeout_s = 0.5};
  bool holds_from_start = false;  ///< the answer is asked for whenever it strikes, if at all
  std::function<bool(BenchState)> is_harmless_when = {};  ///< by then it spoils nothing more
};

/// Every kind, by name. The times follow from the plan's staleness of 0.3 s, the drive's watchdog
/// of 0.5 s and the retries of the link.
const std::vector<FaultKind>& fault_kinds();

}  // namespace rvbench::test
