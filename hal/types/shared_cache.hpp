#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>

namespace rvbench {

/// What is made once for each key, for all threads. Once `most` are kept, all are dropped to make
/// room; each lives on while somebody holds it.
template <typename Key, typename Value>
class SharedCache {
 public:
  explicit SharedCache(std::size_t most) : most_(most) {}

  /// @param make  of the key: a std::shared_ptr<Value>; no two threads are in it at once
  template <typename Make>
  std::shared_ptr<Value> find_or_make(const Key& key, const Make& make) {
    const std::scoped_lock lock(mutex_);
    if (const auto known = values_.find(key); known != values_.end()) return known->second;
    if (values_.size() == most_) values_.clear();
    return values_.emplace(key, make(key)).first->second;
  }

 private:
  std::size_t most_;
  std::mutex mutex_;
  std::map<Key, std::shared_ptr<Value>> values_;
};

}  // namespace rvbench
