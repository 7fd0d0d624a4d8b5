#pragma once

#include <stop_token>
#include <string>

#include "bench/console.hpp"

namespace rvbench::bench {

/// Asks whoever is at the terminal whether the shaft may turn, which it is about to.
/// @return why it may not; "" if it may
std::string why_not_to_turn(Console& console, const std::stop_token& stop);

}  // namespace rvbench::bench
