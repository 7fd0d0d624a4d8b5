#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/command.hpp"

namespace rvbench::bench {

/// Values that are built in, by the name of the option or argument that takes them: "--preset",
/// "PLAN".
using BuiltInValues = std::map<std::string, std::vector<std::string>>;

/// What bash needs to complete the commands, their options, and values that are known; any other
/// value is completed as the name of a file.
/// @return  a script for bash-completion's folder completions/, named rvbench
std::string bash_completion(const std::vector<std::unique_ptr<Command>>& commands,
                            const BuiltInValues& built_in);

}  // namespace rvbench::bench
