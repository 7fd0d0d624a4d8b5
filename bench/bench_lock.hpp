#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "bench/bench_rig.hpp"
#include "bench/file_lock.hpp"

namespace rvbench::bench {

/// What a rig file names, as one process at a time may have it: "/dev/ttyACM0", "192.168.3.10:502",
/// "can0", "ip:192.168.3.30 ad7768-1", each once. A serial line is known by its device, whatever
/// link to it the file names, and a host by its addresses, whatever name.
std::vector<std::string> devices_of(const BenchRig& rig);
std::vector<std::string> devices_of(const DriveSection& drive);

/// Keeps two processes from one device. A serial line that is opened twice gives each reader half
/// of the bytes, many devices take one TCP connection and drop the first, and of two masters
/// neither knows what the other commands.
///
/// How      a lock file for each device, in one folder for all users of this computer; the files
///          stay. TIOCEXCL would cover serial lines only, and not against root
/// Limits   holds off rvbench only, and only of the same computer and container. What a gateway
///          or a front end calls by two names is two devices: nobody has asked it yet
class BenchLock {
 public:
  /// @return the lock on all of them; or what is in use, by which process
  /// @throws std::system_error if there can be no lock
  static std::variant<BenchLock, std::string> take(const std::vector<std::string>& devices,
                                                   const std::filesystem::path& folder);

  /// /run/lock, or /tmp where there is none.
  static std::filesystem::path folder_for_all();

 private:
  std::vector<FileLock> locks_;
};

}  // namespace rvbench::bench
