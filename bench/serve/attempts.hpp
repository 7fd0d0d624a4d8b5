#pragma once

#include <deque>
#include <map>
#include <string>

#include "bench/seconds_source.hpp"

namespace rvbench::bench {

/// Attempts that failed lately, by whom: who has too many may try once a second. Nobody is locked
/// out by what others tried in his name, or from the same proxy.
///
/// Threads  one caller at a time
class FailedAttempts {
 public:
  static constexpr double remembered_s = 300;
  static constexpr double apart_s = 1;             ///< of those beyond the most
  static constexpr std::size_t most_known = 1000;  ///< names; beyond, the oldest is forgotten

  /// @param most  of one name in that time, as fast as they come
  explicit FailedAttempts(std::size_t most, SecondsSource now_s = steady_s)
      : most_(most), now_s_(std::move(now_s)) {}

  bool must_wait(const std::string& who);
  void add(const std::string& who);

 private:
  void forget();

  std::size_t most_;
  SecondsSource now_s_;
  std::map<std::string, std::deque<double>> failed_s_;
};

}  // namespace rvbench::bench
