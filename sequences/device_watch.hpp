#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "hal/clock.hpp"
#include "hal/types/result.hpp"

namespace rvbench::sequences {

/// How old the last answer of a device is, or of one kind of request to it, and when to ask again.
///
/// One that failed is asked again after 20, 40, 80 ... ms, so that waiting for it does not starve
/// the others.
struct DeviceWatch {
  static constexpr double never_seen_s = -1e9;
  static constexpr double always_seen_s = std::numeric_limits<double>::infinity();

  std::string device;
  double period_s = 0;           ///< 0: asked each time
  double seen_s = never_seen_s;  ///< nothing is fresh before its first answer
  double due_s = 0;
  int failures = 0;
  std::string error{};

  /// Asks if it is due. Nothing if it is not, or if there was no answer.
  template <typename T>
  std::optional<T> ask(const hal::Clock& clock, const std::function<Result<T>()>& call) {
    if (clock.now_s() < due_s - 1e-6) return std::nullopt;
    Result<T> answer = call();
    const double now_s = clock.now_s();
    if (!answer) {
      note_failure(now_s, answer.error());
      return std::nullopt;
    }
    failures = 0;
    error.clear();
    seen_s = now_s;
    due_s = now_s + period_s;
    return std::move(answer).value();
  }

  void note_failure(double now_s, const IoError& why);

  /// "brake silent for 0.31 s (timeout ...)"; empty if it was seen within that time.
  std::string lost(double now_s, double stale_after_s) const;
};

}  // namespace rvbench::sequences
