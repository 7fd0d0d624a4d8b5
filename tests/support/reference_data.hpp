#pragma once

#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "tests/support/this_build.hpp"

namespace rvbench::test {

/// Little-endian float64 from the folder RVBENCH_REFERENCE (default <source>/../shared/reference).
/// Empty, with a warning, where the file is not at hand.
inline std::optional<Eigen::VectorXd> reference_data(const std::string& file) {
  const char* folder = std::getenv("RVBENCH_REFERENCE");
  const std::filesystem::path path =
      (folder ? std::filesystem::path(folder) : source_dir() / "../shared/reference") / file;
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    WARN("SKIPPED: no " << path << "; set RVBENCH_REFERENCE to the folder of reference signals");
    return std::nullopt;
  }
  const auto bytes = static_cast<std::streamsize>(std::filesystem::file_size(path));
  Eigen::VectorXd x(bytes / static_cast<std::streamsize>(sizeof(double)));
  in.read(reinterpret_cast<char*>(x.data()), bytes);
  REQUIRE(in.gcount() == bytes);
  return x;
}

}  // namespace rvbench::test
