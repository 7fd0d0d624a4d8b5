#pragma once

#include <filesystem>
#include <string>

#include "bench/judgement.hpp"

namespace rvbench::bench {

/// Enters a run that has just come to its end, and whatever else results.db lacks. The folder is
/// the result: an entry that fails now is made up for by the next run.
/// @return what to say of one that failed, in lines; "" if it is there
std::string enter_result(const std::filesystem::path& root, const std::filesystem::path& folder,
                         const Judgement& judgement);

}  // namespace rvbench::bench
