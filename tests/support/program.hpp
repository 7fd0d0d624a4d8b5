#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/scratch_folder.hpp"

namespace rvbench::test {

/// How a process ended, and what it said.
struct Answer {
  int code = -1;  ///< exit code; minus the signal that killed it
  std::string out;
  std::string err;
};

/// A process of its own, working in `folder`. It is killed if it is not waited for.
class Program {
 public:
  /// @param words  the program's path and its arguments
  Program(const std::filesystem::path& folder, const std::vector<std::string>& words);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  pid_t number() const { return process_; }  ///< of the process

  /// @return whether there was a process left to send it to
  bool send(int signal) const;

  /// Waits until standard error holds `text`; false if the process ended without.
  bool says(const std::string& text);
  std::string said() const;  ///< on standard error, up to now
  Answer wait();

 private:
  ScratchFolder said_;  ///< its own: other tests may run in the same working folder
  std::filesystem::path out_, err_;
  pid_t process_ = -1;
  int status_ = -1;
};

}  // namespace rvbench::test
