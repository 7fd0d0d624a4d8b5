#pragma once

#include <string>

#include "hal/types/outcome.hpp"
#include "tests/faults/fault_run.hpp"

namespace rvbench::test {

/// Judges a run by what the plant did: asked when the controller has returned, and once more long
/// after. What the controller says comes last.
///
/// Every limit follows from physics and settings: the plan's time-outs, the drive's watchdog, the
/// control's tick.
class Oracle {
 public:
  /// All must outlive it.
  Oracle(const FaultCase& fault, const FaultBench& bench, FaultReport& report)
      : fault_(fault), bench_(bench), report_(report) {}

  void after_return();
  void long_after();
  /// @param struck_s      NaN if the fault did not come
  /// @param stop_asked_s  when the driver was first told to stop; NaN if it never was
  void on_shaft_and_brake(double struck_s, bool was_driven, double stop_asked_s,
                          double standstill_timeout_s);
  void on_ending(const Ending& ending);

  void blame(std::string violation) { report_.violations.push_back(std::move(violation)); }

 private:
  void stopped(double shown_s);
  double shown_s(double struck_s, double stop_asked_s) const;
  void released(double standstill_timeout_s);
  void not_released_early(double stop_asked_s, double standstill_timeout_s);

  const FaultCase& fault_;
  const FaultBench& bench_;
  FaultReport& report_;
};

}  // namespace rvbench::test
