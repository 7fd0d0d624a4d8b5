#pragma once

#include "tests/support/program.hpp"

namespace rvbench::test {

/// The path of the program rvbench.
const std::string& rvbench_path();

/// Runs rvbench with these arguments to its end.
Answer rvbench(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

}  // namespace rvbench::test
