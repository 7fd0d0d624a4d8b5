#pragma once

#include <filesystem>
#include <optional>

namespace rvbench::bench {

/// Says to other processes that somebody works in a run folder: a lock on its log.jsonl, which the
/// kernel releases when the process ends, however it ends.
class RunLock {
 public:
  /// Makes log.jsonl if need be. @return nullopt if another holds the lock
  /// @throws std::system_error if there can be no lock
  static std::optional<RunLock> take(const std::filesystem::path& folder);
  RunLock(RunLock&& other) noexcept;
  RunLock& operator=(RunLock&& other) noexcept;
  ~RunLock();

 private:
  explicit RunLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_ = -1;
};

}  // namespace rvbench::bench
