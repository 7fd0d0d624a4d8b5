#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

namespace rvbench::sim {

/// The newest scans of a converter: whoever falls too far behind has lost some, as with the buffer
/// of a real one.
///
/// Threads  any number of readers, one writer, which nobody holds up
class ScanRing {
 public:
  /// @param channels  of one scan
  /// @param scans     that it holds
  ScanRing(std::size_t channels, std::size_t scans);

  /// @param counts  whole scans, one after the other
  void push(const std::vector<std::int32_t>& counts);

  void close();  ///< nobody waits any more

  std::int64_t newest() const;  ///< scans pushed so far

  /// Waits until `count` scans from `first` on are there, at most `patience_s` of real time.
  /// @return as many scans; nothing if they did not come, or if the first ones are lost
  std::optional<std::vector<std::int32_t>> wait(std::int64_t first, std::size_t count,
                                                double patience_s);
  bool has_lost(std::int64_t first) const;  ///< whether that scan has been written over

 private:
  const std::size_t channels_, scans_;
  mutable std::mutex mutex_;
  std::condition_variable pushed_;
  std::vector<std::int32_t> counts_;
  std::int64_t newest_ = 0;
  bool is_closed_ = false;
};

}  // namespace rvbench::sim
