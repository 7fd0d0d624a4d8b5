#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/command.hpp"

namespace rvbench::bench {

/// What bash needs to complete the commands, their options, and values of which there are only
/// some; anything else is completed as the name of a file.
/// @return  a script for bash-completion's folder completions/, named rvbench
std::string bash_completion(const std::vector<std::unique_ptr<Command>>& commands);

}  // namespace rvbench::bench
