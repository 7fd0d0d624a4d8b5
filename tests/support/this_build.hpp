#pragma once

#include <filesystem>
#include <string>

namespace rvbench::test {

/// Folder of the build that the running program is part of: the nearest above it with a
/// CMakeCache.txt. Found at run time, so that a compiler cache may take a test's object from
/// another clone.
/// @throws std::runtime_error where no folder above has one
const std::filesystem::path& build_dir();

/// Value of an entry of that CMakeCache.txt. @throws std::runtime_error where there is none
std::string build_setting(const std::string& name);

/// Top of the sources that were built.
const std::filesystem::path& source_dir();

}  // namespace rvbench::test
