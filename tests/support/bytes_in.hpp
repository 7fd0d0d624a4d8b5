#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace rvbench::test {

/// All that a file holds; nothing where there is none.
inline std::string bytes_in(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace rvbench::test
