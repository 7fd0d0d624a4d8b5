#include "sequences/scribe.hpp"

#include <algorithm>
#include <utility>

namespace rvbench::sequences {

Scribe::Scribe(std::size_t most_bytes) : most_bytes_(most_bytes), thread_([this] { run(); }) {}

Scribe::~Scribe() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool Scribe::post(std::size_t bytes, std::function<void()> job) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_bytes_ + bytes > most_bytes_) return false;
    waiting_bytes_ += bytes;
    jobs_.push_back({bytes, std::move(job)});
  }
  changed_.notify_all();
  return true;
}

void Scribe::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return jobs_.empty() && !is_working_; });
}

bool Scribe::is_busy() const {
  const std::lock_guard lock(mutex_);
  return !jobs_.empty() || is_working_;
}

double Scribe::longest_lag_s() const {
  const std::lock_guard lock(mutex_);
  return longest_lag_s_;
}

void Scribe::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return !jobs_.empty() || is_ending_; });
    if (jobs_.empty()) return;
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    is_working_ = true;
    lock.unlock();
    job.work();
    job.work = nullptr;  // what it holds is freed before its bytes count as free
    lock.lock();
    is_working_ = false;
    const std::chrono::duration<double> lag = std::chrono::steady_clock::now() - job.posted;
    longest_lag_s_ = std::max(longest_lag_s_, lag.count());
    waiting_bytes_ -= job.bytes;
    changed_.notify_all();
  }
}

}  // namespace rvbench::sequences
