#include "sim/scan_ring.hpp"

#include <chrono>

namespace rvbench::sim {

ScanRing::ScanRing(std::size_t channels, std::size_t scans)
    : channels_(channels), scans_(scans), counts_(channels * scans) {}

void ScanRing::push(const std::vector<std::int32_t>& counts) {
  {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i + channels_ <= counts.size(); i += channels_, ++newest_) {
      const std::size_t at = std::size_t(newest_) % scans_ * channels_;
      for (std::size_t channel = 0; channel < channels_; ++channel) {
        counts_[at + channel] = counts[i + channel];
      }
    }
  }
  pushed_.notify_all();
}

void ScanRing::close() {
  {
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
  }
  pushed_.notify_all();
}

std::int64_t ScanRing::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

bool ScanRing::has_lost(std::int64_t first) const {
  const std::lock_guard lock(mutex_);
  return newest_ - first > std::int64_t(scans_);
}

std::optional<std::vector<std::int32_t>> ScanRing::wait(std::int64_t first, std::size_t count,
                                                        double patience_s) {
  std::unique_lock lock(mutex_);
  const auto has_come = [&] { return newest_ >= first + std::int64_t(count); };
  pushed_.wait_for(lock, std::chrono::duration<double>(patience_s),
                   [&] { return is_closed_ || has_come(); });
  if (!has_come() || newest_ - first > std::int64_t(scans_)) return std::nullopt;
  std::vector<std::int32_t> taken;
  taken.reserve(count * channels_);
  for (std::int64_t scan = first; scan < first + std::int64_t(count); ++scan) {
    const auto at = counts_.begin() + std::ptrdiff_t(std::size_t(scan) % scans_ * channels_);
    taken.insert(taken.end(), at, at + std::ptrdiff_t(channels_));
  }
  return taken;
}

}  // namespace rvbench::sim
