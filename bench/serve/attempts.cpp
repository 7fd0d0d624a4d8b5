#include "bench/serve/attempts.hpp"

#include <algorithm>

namespace rvbench::bench {

bool FailedAttempts::must_wait(const std::string& who) {
  forget();
  const auto found = failed_s_.find(who);
  return found != failed_s_.end() && found->second.size() >= most_ &&
         now_s_() - found->second.back() < apart_s;
}

void FailedAttempts::add(const std::string& who) {
  forget();
  failed_s_[who].push_back(now_s_());
  if (failed_s_.size() <= most_known) return;
  failed_s_.erase(std::ranges::min_element(failed_s_, {},
                                           [](const auto& entry) { return entry.second.back(); }));
}

void FailedAttempts::forget() {
  const double since_s = now_s_() - remembered_s;
  for (auto& [who, times_s] : failed_s_) {
    while (!times_s.empty() && times_s.front() < since_s) times_s.pop_front();
  }
  std::erase_if(failed_s_, [](const auto& entry) { return entry.second.empty(); });
}

}  // namespace rvbench::bench
