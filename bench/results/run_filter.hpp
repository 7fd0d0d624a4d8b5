#pragma once

#include <optional>
#include <string>

#include "bench/result_database.hpp"

namespace rvbench::bench {

/// Which runs to tell; what is empty narrows nothing.
struct RunFilter {
  std::string serial;
  std::string from_utc;  ///< "20261121T114559Z", inclusive
  std::string to_utc;    ///< likewise
  std::string verdict;   ///< "PASS", ...; a later judgement does not count
  std::string plan;

  bool operator==(const RunFilter&) const = default;
};

/// Whether a run is one of those. One whose time cannot be read is in no span of time.
bool matches(const RunFilter& filter, const RunRow& row);

/// A time as the user states it, in the form that rows have: "2026-11-21", "20261121",
/// "2026-11-21 11:45", "2026-11-21T11:45:59", each with or without Z. Nothing if it is none.
/// @param last  what was left out is the last of its kind: a day its last second
std::optional<std::string> utc_of_text(const std::string& text, bool last);

/// "2026-11-21 11:45:59" of "20261121T114559Z"; as it is, if it is written otherwise.
std::string readable_utc(const std::string& utc);

/// "2026-11-21T11:45:59Z" of it; "" if it is written otherwise.
std::string iso_utc(const std::string& utc);

/// Days since 1970-01-01, UTC, of "20261121T114559Z"; nothing if it is no such time.
std::optional<double> days_of_utc(const std::string& utc);

}  // namespace rvbench::bench
