#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <thread>

namespace rvbench::sequences {

/// Writes down what others have no time to wait for: a queue of jobs, done one after the other in a
/// thread of its own. A disk or a terminal that hangs holds up the scribe and nobody else.
///
/// Threads  post() from any thread; jobs run in the scribe's, in the order they were posted, and
///          should not throw: of one that does, has_failed() tells, and the next ones are done
class Scribe {
 public:
  /// @param most_bytes  of jobs that wait: what a disk may fall behind before data is lost
  /// @param most_lag_s  for which a job may wait to be done
  explicit Scribe(std::size_t most_bytes,
                  double most_lag_s = std::numeric_limits<double>::infinity());
  ~Scribe();  ///< as finish(), where the scribe was not given up
  Scribe(const Scribe&) = delete;
  Scribe& operator=(const Scribe&) = delete;

  /// @param bytes  that the job holds on to
  /// @return false, and the job is dropped, if as many bytes as allowed wait already, or a job for
  ///         as long as allowed, or if the scribe was given up
  bool post(std::size_t bytes, std::function<void()> job);

  void finish();  ///< waits until everything posted has been done

  /// Waits as finish(), but no longer than that. A scribe that hangs by then is given up: the jobs
  /// that wait are dropped, and the one that runs is left to a thread that nobody waits for. What
  /// that job uses must outlive it.
  /// @return how many jobs were not done; 0 if all were
  std::size_t finish_within(double longest_s);

  bool is_busy() const;
  bool has_failed() const;       ///< a job threw
  double longest_lag_s() const;  ///< from post() until a job was done, at the worst

 private:
  struct Desk;
  static void work_at(Desk& desk);

  const std::size_t most_bytes_;
  const double most_lag_s_;
  const std::shared_ptr<Desk> desk_;  // also the thread's, which may be left behind
  std::thread thread_;
};

}  // namespace rvbench::sequences
