#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/scratch_folder.hpp"
#include "tests/survival/aftermath.hpp"
#include "tests/survival/disk_record.hpp"

namespace rvbench::test {

/// Calls that change something on the disk in a small run, and in the second half of one that was
/// resumed.
struct RunLengths {
  long whole = 0;
  long resumed = 0;
  long in_real_time = 0;  ///< as the first, where others write what the sequencer hands on
};

RunLengths measure_lengths();

/// One crash of one run.
struct Crash {
  std::string what;  ///< "kill at call 17 of a resumed run, seed 4"
  Aftermath aftermath;
};

/// kill -9 in place of a call, or halfway through it; every third is of a resumed run, every
/// seventh of one in real time.
/// @param share  of the run's calls that came before, 0 to 1
Crash kill_run(const RunLengths& lengths, double share, int number);

/// A call fails for want of space, or with an I/O error; once, or from then on.
Crash fail_run(const RunLengths& lengths, double share, int number);

/// A run at the pace of a real one, whose power can be cut at any moment; of one that was resumed
/// what the killed process had not synced is lost with it.
class RecordedRun {
 public:
  /// @param resume  its second half, after a kill
  RecordedRun(const RunLengths& lengths, bool resume);
  Crash cut(std::uint64_t seed, Without without = Without::nothing) const;

 private:
  ScratchFolder scratch_;
  bool resume_;
  std::vector<DiskEntry> entries_;  ///< of all processes
  std::size_t begin_ = 0;           ///< those of the last one
};

}  // namespace rvbench::test
