#include "hal/hdf5/disk_sync.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>

#include "hal/sync_folder.hpp"

namespace rvbench::hal::hdf5 {

DiskSync::DiskSync(const std::filesystem::path& file)
    : descriptor_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0) {
    error_ = errno;
    return;
  }
  ::flock(descriptor_, LOCK_SH | LOCK_NB);
  sync_folder(file);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

DiskSync::~DiskSync() {
  if (descriptor_ < 0) return;
  thread_.request_stop();
  thread_.join();
  ::close(descriptor_);
}

void DiskSync::sync() noexcept {
  int none = 0;
  if (::fdatasync(descriptor_) != 0) error_.compare_exchange_strong(none, errno);
}

void DiskSync::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, stop, std::chrono::seconds(1), [] { return false; })) {
    if (stop.stop_requested()) return;
    sync();
  }
}

}  // namespace rvbench::hal::hdf5
