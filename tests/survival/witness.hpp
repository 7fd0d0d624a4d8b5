#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/survival/disk_record.hpp"
#include "tests/survival/watched_recording.hpp"

namespace rvbench::test {

/// A block that was handed over, with all before it of the same point and clock.
struct Handed {
  std::int64_t time_ns = 0;
  int point = 0;
  bool is_torque = false;
  SampleSum sum;
};

struct Ended {
  SampleSum accelerations, torques;
  std::string status;
};

/// What writing processes had promised until something ended them.
struct Witness {
  bool made = false;           ///< the run folder
  std::map<int, Ended> ended;  ///< points
  std::optional<std::string> verdict;
  std::vector<std::string> unwritten;  ///< result files, each with why, as the verdict tells
  std::string refusal;                 ///< why there was no run at all
  std::string thrown;                  ///< what came out of the run instead of a verdict
  bool at_rest = false;                ///< the shaft, when the run had ended
  bool entered = false;                ///< the verdict, in the table of results
  std::string not_entered;             ///< why it was not, or another was not
  std::string struck;                  ///< path of the call that was made to fail
  bool struck_at_end = false;          ///< the verdict had been told by then
  long calls = 0;                      ///< told at the end of a process
  std::string recording;               ///< file that was begun last
  std::vector<Handed> handed;          ///< to that file
  std::int64_t killed_ns = 0;

  /// Takes one told entry.
  void hear(const DiskEntry& entry);
};

/// All that a process told, after what was told before.
Witness heard(Witness before, const std::vector<DiskEntry>& entries);

}  // namespace rvbench::test
