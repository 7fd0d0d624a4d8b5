#pragma once

#include <string>

namespace rvbench::bench {

/// Times of records against this computer's clock, as "20261121T114559Z".

/// Whether it lies so far ahead of now that clocks cannot both be right. Two computers' clocks, or
/// one that was set, may be a few minutes apart.
bool is_ahead(const std::string& utc, const std::string& now_utc);

/// What is wrong with the age of something that must not be older than `max_age_h`: "is of
/// 2026-11-20 11:45:59, 30 h ago, at most 24 h count"; empty: nothing.
std::string age_fault(const std::string& utc, double max_age_h, const std::string& now_utc);

/// "2026-11-21" of "20261121T235959Z"
std::string day_of(const std::string& utc);

/// Days from one time to another; NaN if one of them is none.
double days_between(const std::string& from_utc, const std::string& to_utc);

}  // namespace rvbench::bench
