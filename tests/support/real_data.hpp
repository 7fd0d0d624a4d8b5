#pragma once

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "tests/support/this_build.hpp"

namespace rvbench::test {

/// Where the real recordings are: RVBENCH_DATA, else ../shared/data. Warns if they are absent.
inline std::optional<std::filesystem::path> data_folder() {
  const char* named = std::getenv("RVBENCH_DATA");
  const std::filesystem::path folder = named != nullptr ? named : source_dir() / "../shared/data";
  if (std::filesystem::is_directory(folder)) return folder;
  WARN("skipped: no real recordings in " << folder << " (set RVBENCH_DATA)");
  return std::nullopt;
}

}  // namespace rvbench::test
