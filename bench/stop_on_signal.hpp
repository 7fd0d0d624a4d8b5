#pragma once

#include <array>
#include <csignal>
#include <stop_token>
#include <thread>

namespace rvbench::bench {

/// What ends a job between two of its steps. It is no std::exception: who makes do without a step
/// that failed must not take this for one.
struct Interrupted {};

/// @throws Interrupted if a stop has been requested
inline void end_if_stopped(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Interrupted();
}

/// While it lives, SIGINT, SIGTERM, SIGHUP (the terminal is gone), SIGQUIT (Ctrl-\) and whatever
/// else others may send to end a process request a stop instead of killing it. Further ones change
/// nothing: the teardown that stops the shaft cannot be skipped from the keyboard. A SIGHUP that
/// the caller ignores (nohup) stays ignored. SIGPIPE and SIGXFSZ are ignored, too: a run does not
/// end because nobody reads, and a file that may not grow is an error of the write.
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
  static constexpr std::array signals{SIGINT,  SIGTERM, SIGHUP,    SIGQUIT, SIGUSR1,
                                      SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGXCPU,
                                      SIGPWR,  SIGIO,   SIGSTKFLT, SIGPIPE, SIGXFSZ};

  std::stop_source source_;
  std::array<struct sigaction, signals.size()> previous_{};
  std::thread watcher_;
};

}  // namespace rvbench::bench
