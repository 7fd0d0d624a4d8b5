#pragma once

#include <string>

#include "bench/judgement.hpp"

/// What reports say of a verdict, as plain text.
namespace rvbench::bench::report {

/// What the word means for the person who holds the unit.
const char* meaning_of(const Judgement& judgement);

/// "20260102T030405Z" → "2026-01-02 03:04:05 UTC"; anything else as it is.
std::string readable_time(const std::string& utc);

/// "4 of 4 recorded"
std::string points_text(const Judgement& judgement);

}  // namespace rvbench::bench::report
