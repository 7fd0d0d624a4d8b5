#include "bench/serve/sessions.hpp"

#include <algorithm>

#include "bench/sha256.hpp"

namespace rvbench::bench {

// By hash, so that how long the search takes tells nothing of the cookies there are.
std::string Sessions::begin(const std::string& user, Role role) {
  const std::string cookie = random_hex(32);
  const std::lock_guard lock(mutex_);
  forget();
  if (entries_.size() >= most) {
    entries_.erase(std::ranges::min_element(
        entries_, {}, [](const auto& entry) { return entry.second.begun_s; }));
  }
  entries_[sha256_of_text(cookie)] = {{user, role, random_hex(32)}, now_s_()};
  return cookie;
}

std::optional<Session> Sessions::find(const std::string& cookie) {
  const std::lock_guard lock(mutex_);
  forget();
  const auto found = entries_.find(sha256_of_text(cookie));
  if (found == entries_.end()) return std::nullopt;
  return found->second.session;
}

void Sessions::end(const std::string& cookie) {
  const std::lock_guard lock(mutex_);
  entries_.erase(sha256_of_text(cookie));
}

void Sessions::forget() {
  const double since_s = now_s_() - longest_s;
  std::erase_if(entries_, [&](const auto& entry) { return entry.second.begun_s < since_s; });
}

}  // namespace rvbench::bench
