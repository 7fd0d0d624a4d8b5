#pragma once

#include <array>
#include <csignal>
#include <stop_token>
#include <thread>

namespace rvbench::bench {

/// While it lives, SIGINT, SIGTERM, SIGHUP (the terminal is gone) and SIGQUIT (Ctrl-\) request a
/// stop instead of killing the process. Further ones change nothing: the teardown that stops the
/// shaft cannot be skipped from the keyboard. A SIGHUP that the caller ignores (nohup) stays
/// ignored. SIGPIPE is ignored, too: a run does not end because nobody reads.
///
/// Threads  one object at a time in a process
class StopOnSignal {
 public:
  StopOnSignal();
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE};

  std::stop_source source_;
  std::array<struct sigaction, signals.size()> previous_{};
  std::thread watcher_;
};

}  // namespace rvbench::bench
