#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/qualification/self_test_spec.hpp"
#include "hal/types/outcome.hpp"
#include "hal/types/recording.hpp"
#include "sequences/phase.hpp"

namespace rvbench::bench {

enum class SelfTestWord { passed, failed, cannot_tell, skipped };

const char* to_string(SelfTestWord word);  ///< "pass", "fail", "cannot tell", "skipped"

/// One value of a step, of one channel or device.
struct SelfTestReading {
  std::string of;  ///< "accel_1x", "drive"
  double value = not_known;
  double limit = not_known;
  bool is_least = false;  ///< the limit: the value must reach it; else it must not exceed it
  std::string unit;
  SelfTestWord word = SelfTestWord::cannot_tell;
};

/// What a step came to.
struct SelfTestResult {
  std::string step;
  SelfTestWord word = SelfTestWord::cannot_tell;
  std::string reason = "it was not reached";  ///< one sentence
  std::vector<SelfTestReading> readings;
};

/// A reading held against its limit; what is not a number cannot be told.
SelfTestReading at_most(std::string of, double value, double limit, std::string unit);
SelfTestReading at_least(std::string of, double value, double limit, std::string unit);

/// Word and reason of a step by its readings: the gravest of them, and all that are not well.
/// @param what  is read: "noise, rms"
void conclude(SelfTestResult& result, const std::string& what);

/// The reading that is nearest to its limit, or the farthest beyond; null if there is none.
const SelfTestReading* worst_reading(const SelfTestResult& result);

/// One step of a station's self-test. A new step is a new file in steps/ and one line in
/// self_test_steps.cpp.
///
/// Order  one after the other, on a bench that is armed: see sequences::BenchLoop. What it leaves
///        turning the sequencer stops, on every path
class SelfTestStep {
 public:
  virtual ~SelfTestStep() = default;
  virtual std::string_view name() const = 0;
  /// What it asks of the bench at most: speed, load and about how long.
  virtual sequences::Segment segment(const SelfTestSpec& spec) const = 0;
  /// @return how the self-test must end, if it cannot go on
  virtual std::optional<Ending> run(sequences::BenchLoop& loop, const SelfTestSpec& spec,
                                    SelfTestResult& result) = 0;
};

}  // namespace rvbench::bench
