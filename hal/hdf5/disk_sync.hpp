#pragma once

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

namespace rvbench::hal::hdf5 {

/// Has what was written to a file put on the disk each second, so that a power failure costs no
/// more. In a thread of its own: a slow disk must not hold up the loop that watches the shaft.
/// Real seconds, whatever the rig's clock says: this is about the disk, not about the bench.
///
/// While it lives it also holds a shared lock on the file, by which repair_recording() sees that
/// somebody is still writing.
class DiskSync {
 public:
  /// Status by error(): a file that cannot be opened is reported there too.
  explicit DiskSync(const std::filesystem::path& file);
  ~DiskSync();
  DiskSync(const DiskSync&) = delete;
  DiskSync& operator=(const DiskSync&) = delete;

  void sync() noexcept;                 ///< now, returning when it is on the disk
  int error() const { return error_; }  ///< errno of the first failure; 0 if none

 private:
  void run(const std::stop_token& stop);

  int descriptor_;
  std::atomic<int> error_{0};
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;
};

}  // namespace rvbench::hal::hdf5
