#include "bench/qualification/self_test_observer.hpp"

#include <ostream>

namespace rvbench::bench {

SelfTestObserver::SelfTestObserver(Console& console, ProgressBar& bar)
    : console_(console), bar_(bar) {}

void SelfTestObserver::progress(double done_s, double total_s, const std::string& doing) {
  const std::lock_guard lock(mutex_);
  bar_.show("self-test", total_s > 0 ? done_s / total_s : 0, doing);
}

// A shaft that turns waits for no terminal that has been stopped.
void SelfTestObserver::event(double, const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (takes_a_line(console_)) console_.err << "  > " << text << std::endl;
}

}  // namespace rvbench::bench
