#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "bench/qualification/self_test_step.hpp"
#include "hal/rig.hpp"
#include "sequences/sequencer.hpp"

namespace rvbench::bench {

/// What a self-test of the station came to.
struct SelfTest {
  std::vector<SelfTestResult> steps;  ///< of all there are, those not reached included
  /// PASS means only that all steps were done: passed() has the last word.
  Ending ending;
  /// As RunSummary's hung ones: the process must exit without destroying rig or observer.
  bool must_exit = false;

  bool passed(const SelfTestSpec& spec) const;
  bool has_failed_step() const;  ///< whatever came after it
  /// One sentence: the steps that did not pass, and why.
  std::string reason(const SelfTestSpec& spec) const;
};

/// Runs all steps on the bench, by the sequencer: connected, armed, watched by the supervisor and
/// the interlocks; whatever happens, the shaft ends up stopped and the brake released.
///
/// Nothing is recorded. In real time the observer must outlive must_exit.
/// @param with_tap  false: nobody is there to tap, and the step is skipped
SelfTest run_self_test(const SelfTestSpec& spec, bool with_tap, hal::Rig& rig,
                       sequences::RunObserver& observer, std::stop_token stop);

/// What the self-test asks for and the rig cannot do, in words; empty: nothing.
std::string why_not_on(const hal::Rig& rig, const SelfTestSpec& spec);

}  // namespace rvbench::bench
