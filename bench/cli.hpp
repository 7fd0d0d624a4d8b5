#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/command.hpp"
#include "bench/console.hpp"

namespace rvbench::bench {

/// Runs the command that `arguments` (without the program's name) ask for. With --json, one that
/// was refused is a JSON document on standard output as well.
/// @return its exit code; 2 for arguments that make no sense, 1 if it threw
int run_cli(const std::vector<std::string>& arguments,
            const std::vector<std::unique_ptr<Command>>& commands, Console& console);

}  // namespace rvbench::bench
