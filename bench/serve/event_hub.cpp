#include "bench/serve/event_hub.hpp"

#include <chrono>

namespace rvbench::bench {

void EventHub::publish(const std::string& name, const std::string& data) {
  {
    const std::lock_guard lock(mutex_);
    events_.push_back({++newest_, name, data});
    if (events_.size() > kept) events_.pop_front();
    if (name == "strip") strips_.push_back(data);
    if (strips_.size() > kept_strips) strips_.pop_front();
  }
  changed_.notify_all();
}

EventHub::News EventHub::wait_after(std::uint64_t number, double longest_s) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(longest_s),
                    [&] { return is_over_ || newest_ > number; });
  News news;
  news.is_over = is_over_;
  if (events_.empty() || newest_ <= number) return news;
  news.has_hole = events_.front().number > number + 1;
  for (const LiveEvent& event : events_) {
    if (event.number > number) news.events.push_back(event);
  }
  return news;
}

std::uint64_t EventHub::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

std::vector<std::string> EventHub::strips() const {
  const std::lock_guard lock(mutex_);
  return {strips_.begin(), strips_.end()};
}

void EventHub::forget_strips() {
  const std::lock_guard lock(mutex_);
  strips_.clear();
}

void EventHub::close() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  changed_.notify_all();
}

}  // namespace rvbench::bench
