#pragma once

#include <mutex>
#include <string>

#include "bench/console.hpp"
#include "bench/progress_bar.hpp"
#include "sequences/sequencer.hpp"

namespace rvbench::bench {

/// Shows how far a self-test is, and what somebody at the bench has to know or do.
/// Threads  any
class SelfTestObserver final : public sequences::RunObserver {
 public:
  SelfTestObserver(Console& console, ProgressBar& bar);

  void progress(double done_s, double total_s, const std::string& doing) override;
  void event(double time_s, const std::string& text) override;

 private:
  Console& console_;
  ProgressBar& bar_;
  std::mutex mutex_;  // of the screen
};

}  // namespace rvbench::bench
