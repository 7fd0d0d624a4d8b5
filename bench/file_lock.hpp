#pragma once

#include <filesystem>
#include <optional>

namespace rvbench::bench {

/// A file that one holder at a time has: a flock(), which the kernel releases when the process
/// ends, however it ends.
class FileLock {
 public:
  /// Makes the file if need be, for this user to write. @return nullopt if another holds the lock
  /// @throws std::system_error if there can be no lock
  static std::optional<FileLock> take(const std::filesystem::path& file);
  /// The same in a folder that all users share: any of them may lock the file.
  static std::optional<FileLock> take_shared(const std::filesystem::path& file);

  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

  /// Leaves the number of this process in the file, in place of what it holds.
  void sign() const;

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  static std::optional<FileLock> lock(int descriptor, const std::filesystem::path& file);

  int descriptor_ = -1;
};

}  // namespace rvbench::bench
