#pragma once

#include <string>

namespace rvbench::test {

/// What is to become of this process's calls that change files below `root`: write, pwrite,
/// writev, fsync, fdatasync, ftruncate, rename, unlink, remove, mkdir, and open where it may make a
/// file. They are counted from 1.
///
/// The functions of those names in disk_calls.cpp stand before the C library's, also for HDF5 and
/// the C++ library: symbols of the program go first.
struct DiskPlan {
  std::string root;
  std::string record;            ///< file for the record; outside of `root`
  bool with_calls = false;       ///< record the calls, too, and not only what is told
  long kill_at = 0;              ///< kill -9 in place of that call; 0: never
  bool kill_halfway = false;     ///< a write is half done by then
  long fail_at = 0;              ///< that call fails; 0: never
  int error = 0;                 ///< errno that it fails with
  bool fail_ever_after = false;  ///< and all later ones that ask for space or fail as it did
};

/// From now on.
void watch_disk(const DiskPlan& plan);

/// Adds what the process has just promised to somebody to the record.
void tell(const std::string& text);

long disk_calls();  ///< counted so far

}  // namespace rvbench::test
