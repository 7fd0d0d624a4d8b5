#pragma once

#include <chrono>
#include <functional>

namespace rvbench::bench {

/// Work that may be held up, by a disk or by a lock that a hung thread has. What it uses must
/// outlive the process.
/// @return whether it was done in time
bool try_for(std::chrono::seconds longest, const std::function<void()>& work) noexcept;

}  // namespace rvbench::bench
