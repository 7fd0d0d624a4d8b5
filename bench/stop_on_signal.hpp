#pragma once

#include <csignal>
#include <stop_token>
#include <thread>

namespace rvbench::bench {

/// While it lives, SIGINT and SIGTERM request a stop instead of killing the process. Further ones
/// change nothing: the teardown that stops the shaft cannot be skipped from the keyboard.
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
  std::stop_source source_;
  struct sigaction previous_int_ {};
  struct sigaction previous_term_ {};
  std::thread watcher_;
};

}  // namespace rvbench::bench
