#pragma once

#include <stop_token>
#include <string>
#include <variant>

#include "bench/tpa_study.hpp"

namespace rvbench::bench {

/// Judges the recording of a joint's reducer as `judge` does.
/// @return the judgement, or why the recording is refused: "file: what"
/// @throws Interrupted
std::variant<ReducerAnswer, std::string> judge_reducer(const TpaReducer& reducer,
                                                       const std::stop_token& stop);

}  // namespace rvbench::bench
