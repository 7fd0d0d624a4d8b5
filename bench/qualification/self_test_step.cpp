#include "bench/qualification/self_test_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rvbench::bench {
namespace {

SelfTestReading held(SelfTestReading reading) {
  if (!std::isfinite(reading.value)) return reading;
  const bool is_well =
      reading.is_least ? reading.value >= reading.limit : reading.value <= reading.limit;
  reading.word = is_well ? SelfTestWord::passed : SelfTestWord::failed;
  return reading;
}

// Of its limit, so that 1 is at it and more is beyond.
double share_of(const SelfTestReading& reading) {
  if (!std::isfinite(reading.value)) return HUGE_VAL;
  return reading.is_least ? reading.limit / std::max(reading.value, 1e-300)
                          : reading.value / reading.limit;
}

std::string text_of(const SelfTestReading& reading) {
  if (!std::isfinite(reading.value)) return reading.of + " has no value";
  return fmt::format("{} {:.3g} {}, {} {:.3g}", reading.of, reading.value, reading.unit,
                     reading.is_least ? "at least" : "at most", reading.limit);
}

}  // namespace

const char* to_string(SelfTestWord word) {
  switch (word) {
    case SelfTestWord::passed: return "pass";
    case SelfTestWord::failed: return "fail";
    case SelfTestWord::skipped: return "skipped";
    case SelfTestWord::cannot_tell: break;
  }
  return "cannot tell";
}

SelfTestReading at_most(std::string of, double value, double limit, std::string unit) {
  return held({std::move(of), value, limit, false, std::move(unit)});
}

SelfTestReading at_least(std::string of, double value, double limit, std::string unit) {
  return held({std::move(of), value, limit, true, std::move(unit)});
}

const SelfTestReading* worst_reading(const SelfTestResult& result) {
  const auto worst = std::ranges::max_element(result.readings, {}, share_of);
  return worst == result.readings.end() ? nullptr : &*worst;
}

void conclude(SelfTestResult& result, const std::string& what) {
  const auto count = [&](SelfTestWord word) {
    return std::ranges::count(result.readings, word, &SelfTestReading::word);
  };
  result.word = SelfTestWord::passed;
  if (result.readings.empty() || count(SelfTestWord::cannot_tell) > 0) {
    result.word = SelfTestWord::cannot_tell;
  }
  if (count(SelfTestWord::failed) > 0) result.word = SelfTestWord::failed;
  if (result.readings.empty()) {
    result.reason = what + ": nothing was read";
    return;
  }
  if (result.word == SelfTestWord::passed) {
    result.reason = fmt::format("{}: {} of {} is nearest to its limit", what,
                                text_of(*worst_reading(result)), result.readings.size());
    return;
  }
  result.reason = what + ":";
  std::string between = " ";
  for (const SelfTestReading& reading : result.readings) {
    if (reading.word == SelfTestWord::passed) continue;
    result.reason += std::exchange(between, "; ") + text_of(reading);
  }
}

}  // namespace rvbench::bench
