#include "hal/hdf5/disk_sync.hpp"

#include <unistd.h>

#include <cerrno>

namespace rvbench::hal::hdf5 {

DiskSync::DiskSync(int descriptor, std::chrono::milliseconds interval)
    : descriptor_(descriptor),
      interval_(interval),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

DiskSync::~DiskSync() {
  thread_.request_stop();
  thread_.join();
}

void DiskSync::sync() noexcept {
  int none = 0;
  if (::fdatasync(descriptor_) != 0) error_.compare_exchange_strong(none, errno);
}

void DiskSync::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    // From begin to begin: a slow disk is not given the interval on top.
    const auto due = std::chrono::steady_clock::now() + interval_;
    sync();
    wake_.wait_until(lock, stop, due, [] { return false; });
  }
}

}  // namespace rvbench::hal::hdf5
