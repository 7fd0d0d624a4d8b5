#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/factory/outbox.hpp"
#include "hal/types/result.hpp"

namespace rvbench::bench {

/// A run that the factory is not told of.
struct SkippedRun {
  std::string folder;  ///< below the root
  std::string why;

  auto operator<=>(const SkippedRun&) const = default;
};

/// Puts every judged run below the root into the outbox that is not there yet, as it was judged,
/// oldest first. @return those that cannot be told
Result<std::vector<SkippedRun>> take_in(const std::filesystem::path& root, const std::string& step,
                                        Outbox& outbox);

/// Looks whether a run below the root has come to its end, or to another one.
class RunWatch {
 public:
  explicit RunWatch(std::filesystem::path root) : root_(std::move(root)) {}

  /// @return whether anything has changed since this was asked last; the first time, true
  bool has_changed();

 private:
  using Times = std::map<std::filesystem::path, std::filesystem::file_time_type>;
  std::filesystem::path root_;
  bool has_looked_ = false;
  Times seen_;  // of each run's hashes, which are written last
};

}  // namespace rvbench::bench
