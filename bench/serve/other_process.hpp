#pragma once

#include <sys/types.h>

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

namespace rvbench::bench {

/// What a program that was asked something said.
struct ProgramAnswer {
  int code = -1;  ///< exit code; -1: it could not be started, was killed, or took too long
  std::string out;
  std::string err;
};

/// Asks a program and waits for its answer; one that takes longer is killed, and so is one whose
/// answer nobody waits for any more.
/// @param words  the program's path and its arguments; no shell sees them
ProgramAnswer ask_program(const std::vector<std::string>& words, double longest_s = 20,
                          const std::stop_token& stop = {});

/// A run in a process of its own, which goes on whatever becomes of who started it: in a session of
/// its own, its output in files, and a lock that the kernel holds for as long as it lives. Whoever
/// comes later finds it by that lock.
///
/// Files    in the folder: run.lock (with the process's number), answer.json (standard output),
///          run.log (standard error)
/// Threads  one caller at a time. The run has the priority of the thread that starts it
class RunProcess {
 public:
  explicit RunProcess(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// @return why it could not be started; "" if it was
  std::string start(const std::vector<std::string>& words);
  bool is_alive();
  /// Asks it to end in order (SIGTERM). @return whether there was one to ask
  bool stop();
  std::filesystem::path answer_file() const { return folder_ / "answer.json"; }
  std::filesystem::path log_file() const { return folder_ / "run.log"; }

 private:
  std::filesystem::path lock_file() const { return folder_ / "run.lock"; }

  const std::filesystem::path folder_;
  pid_t child_ = -1;
};

}  // namespace rvbench::bench
