#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace rvbench::sequences {

/// Writes down what others have no time to wait for: a queue of jobs, done one after the other in a
/// thread of its own. A disk or a terminal that hangs holds up the scribe and nobody else.
///
/// Threads  post() from any thread; jobs run in the scribe's, in the order they were posted, and
/// must
///          not throw
class Scribe {
 public:
  /// @param most_bytes  of jobs that wait: what a disk may fall behind before data is lost
  explicit Scribe(std::size_t most_bytes);
  ~Scribe();  ///< as finish()
  Scribe(const Scribe&) = delete;
  Scribe& operator=(const Scribe&) = delete;

  /// @param bytes  that the job holds on to
  /// @return false, and the job is dropped, if as many bytes as allowed wait already
  bool post(std::size_t bytes, std::function<void()> job);

  void finish();  ///< waits until everything posted has been done
  bool is_busy() const;
  double longest_lag_s() const;  ///< from post() until a job was done, at the worst

 private:
  struct Job {
    std::size_t bytes;
    std::function<void()> work;
    std::chrono::steady_clock::time_point posted = std::chrono::steady_clock::now();
  };

  void run();

  const std::size_t most_bytes_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;
  std::size_t waiting_bytes_ = 0;
  double longest_lag_s_ = 0;
  bool is_working_ = false;
  bool is_ending_ = false;
  std::thread thread_;
};

}  // namespace rvbench::sequences
