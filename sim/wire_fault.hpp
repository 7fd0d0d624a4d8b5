#pragma once

#include <limits>
#include <mutex>

namespace rvbench::sim {

/// How a device on a wire misbehaves.
enum class WireFault {
  none,
  late,       ///< does what it was asked, answers after the client's patience has ended
  silent,     ///< reads the request, does nothing and never answers
  garbled,    ///< does what it was asked, answers nonsense
  truncated,  ///< does what it was asked, answers the beginning only
  doubled,    ///< does what it was asked, answers twice: the second one waits for the next request
  merged,     ///< as doubled, but both in one segment, and the first is that of an older request
  busy,       ///< answers that it cannot now, and does nothing
  deaf,       ///< answers writes as if it had done them, and does nothing
  frozen,     ///< answers reads with what it last answered in good health
  dead        ///< closes the connection and every new one
};

/// When a fault holds: after `after_requests` more sound ones, for `requests`. One that is to
/// begin at a time is injected then.
struct WireFaultPlan {
  WireFault fault = WireFault::none;
  int after_requests = 0;  ///< counted from inject()
  int requests = std::numeric_limits<int>::max();
  int exception_code = 6;  ///< of WireFault::busy
};

/// The fault plan of one device; a new one replaces the old. All calls may overlap.
class WireFaultSwitch {
 public:
  void inject(const WireFaultPlan& plan) {
    const std::lock_guard lock(mutex_);
    plan_ = plan;
  }

  /// What to do with the request that has just come; counts it.
  WireFault take() {
    const std::lock_guard lock(mutex_);
    if (plan_.requests <= 0) return WireFault::none;
    if (plan_.after_requests > 0) {
      --plan_.after_requests;
      return WireFault::none;
    }
    --plan_.requests;
    if (plan_.fault != WireFault::none) ++taken_;
    return plan_.fault;
  }

  int exception_code() const {
    const std::lock_guard lock(mutex_);
    return plan_.exception_code;
  }

  /// How often somebody met the fault: a request, or a connection that was closed at once.
  int met() const {
    const std::lock_guard lock(mutex_);
    return taken_;
  }

  /// True if a new connection is to be closed at once; not one of the plan's requests.
  bool is_dead() {
    const std::lock_guard lock(mutex_);
    const bool dead =
        plan_.fault == WireFault::dead && plan_.after_requests <= 0 && plan_.requests > 0;
    if (dead) ++taken_;
    return dead;
  }

 private:
  mutable std::mutex mutex_;
  WireFaultPlan plan_;
  int taken_ = 0;
};

}  // namespace rvbench::sim
