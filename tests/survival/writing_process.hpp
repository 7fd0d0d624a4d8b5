#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/survival/disk_calls.hpp"
#include "tests/survival/small_run.hpp"

namespace rvbench::test {

/// A process that makes a small run and tells what it promises, until something ends it.
struct WritingProcess {
  std::filesystem::path runs;
  SmallRunOptions run;
  DiskPlan disk;
};

inline constexpr const char* writing_process = "writing-process";

/// The program's words that make it one: its own path, `writing_process`, and the rest.
std::vector<std::string> words_of(const WritingProcess& process);

/// Is one. @param words  after `writing_process`
int be_writing_process(const std::vector<std::string>& words);

}  // namespace rvbench::test
