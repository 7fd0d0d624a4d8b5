#pragma once

#include <optional>

#include "hal/types/outcome.hpp"
#include "sequences/bench_loop.hpp"
#include "sequences/plan.hpp"

namespace rvbench::sequences {

/// How the shaft ran down.
struct RunDown {
  bool stopped = false;           ///< standstill was measured
  std::optional<Ending> trouble;  ///< what befell the bench meanwhile: a trip, a lost device
};

/// Lets the stopped shaft run down and keeps the brake's load on, until standstill is measured or
/// the teardown's time-out has passed. Devices that do not answer are no reason to leave early:
/// with a dead link the drive stops by its own watchdog. Of a shaft that nobody has told to turn
/// it waits for a word of angle or drive no longer than a value may be old.
///
/// Standstill is what the angle says, or the drive if the angle is lost; if both answer, both.
RunDown wait_for_standstill(BenchLoop& loop, const TestPlan& plan);

}  // namespace rvbench::sequences
