#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace rvbench::hal::hdf5 {

/// Has what was written to a file put on the disk at intervals, so that a power failure costs no
/// more. In a thread of its own: a slow disk must not hold up the loop that watches the shaft.
/// Real time, whatever the rig's clock says: this is about the disk, not about the bench.
class DiskSync {
 public:
  /// @param descriptor  open as long as this lives
  DiskSync(int descriptor, std::chrono::milliseconds interval);
  ~DiskSync();
  DiskSync(const DiskSync&) = delete;
  DiskSync& operator=(const DiskSync&) = delete;

  void sync() noexcept;  ///< now, returning when it is on the disk; legal from any thread
  /// errno of the first failure, 0 if none. It stays: after a failure the kernel forgets what it
  /// could not write, and the next sync would call all well.
  int error() const { return error_; }

 private:
  void run(const std::stop_token& stop);

  int descriptor_;
  std::chrono::milliseconds interval_;
  std::atomic<int> error_{0};
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;
};

}  // namespace rvbench::hal::hdf5
