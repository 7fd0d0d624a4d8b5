#include "sequences/scribe.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <utility>

namespace rvbench::sequences {
namespace {

using Steady = std::chrono::steady_clock;

struct Job {
  std::size_t bytes;
  std::function<void()> work;
  Steady::time_point posted = Steady::now();
};

}  // namespace

struct Scribe::Desk {
  mutable std::mutex mutex;  // guards all
  std::condition_variable changed;
  std::deque<Job> jobs;
  std::size_t waiting_bytes = 0;
  double longest_lag_s = 0;
  Steady::time_point at_work_on;  // when that job was posted
  bool is_working = false;
  bool is_ending = false;
  bool is_given_up = false;
  std::atomic<bool> has_failed = false;

  bool is_idle() const { return jobs.empty() && !is_working; }
  double lag_s() const {  // of the oldest job
    if (is_idle()) return 0;
    const auto oldest = is_working ? at_work_on : jobs.front().posted;
    return std::chrono::duration<double>(Steady::now() - oldest).count();
  }
};

Scribe::Scribe(std::size_t most_bytes, double most_lag_s)
    : most_bytes_(most_bytes),
      most_lag_s_(most_lag_s),
      desk_(std::make_shared<Desk>()),
      thread_([desk = desk_] { work_at(*desk); }) {}

Scribe::~Scribe() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(desk_->mutex);
    desk_->is_ending = true;
  }
  desk_->changed.notify_all();
  thread_.join();
}

bool Scribe::post(std::size_t bytes, std::function<void()> job) {
  {
    const std::lock_guard lock(desk_->mutex);
    if (desk_->is_given_up || desk_->waiting_bytes + bytes > most_bytes_) return false;
    if (desk_->lag_s() > most_lag_s_) return false;
    desk_->jobs.push_back({bytes, std::move(job)});
    desk_->waiting_bytes += bytes;
  }
  desk_->changed.notify_all();
  return true;
}

void Scribe::finish() {
  std::unique_lock lock(desk_->mutex);
  desk_->changed.wait(lock, [this] { return desk_->is_idle() || desk_->is_given_up; });
}

std::size_t Scribe::finish_within(double longest_s) {
  std::unique_lock lock(desk_->mutex);
  const std::chrono::duration<double> longest(longest_s);
  if (desk_->changed.wait_for(lock, longest, [this] { return desk_->is_idle(); })) return 0;
  const std::size_t undone = desk_->jobs.size() + (desk_->is_working ? 1 : 0);
  desk_->jobs.clear();
  desk_->is_ending = desk_->is_given_up = true;
  if (thread_.joinable()) thread_.detach();
  return undone;
}

bool Scribe::is_busy() const {
  const std::lock_guard lock(desk_->mutex);
  return !desk_->is_idle();
}

bool Scribe::has_failed() const { return desk_->has_failed; }

double Scribe::longest_lag_s() const {
  const std::lock_guard lock(desk_->mutex);
  return desk_->longest_lag_s;
}

void Scribe::work_at(Desk& desk) {
  std::unique_lock lock(desk.mutex);
  for (;;) {
    desk.changed.wait(lock, [&desk] { return !desk.jobs.empty() || desk.is_ending; });
    if (desk.jobs.empty()) return;
    Job job = std::move(desk.jobs.front());
    desk.jobs.pop_front();
    desk.is_working = true;
    desk.at_work_on = job.posted;
    lock.unlock();
    try {
      job.work();
    } catch (...) {
      desk.has_failed = true;
    }
    job.work = nullptr;  // what it holds is freed before its bytes count as free
    lock.lock();
    desk.is_working = false;
    const std::chrono::duration<double> lag = Steady::now() - job.posted;
    desk.longest_lag_s = std::max(desk.longest_lag_s, lag.count());
    desk.waiting_bytes -= job.bytes;
    desk.changed.notify_all();
  }
}

}  // namespace rvbench::sequences
