#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/ledger.hpp"
#include "bench/qualification/qualification_section.hpp"

/// The golden unit's runs in the ledger: a line when one begins, of its start.json, and one when it
/// has come to its end, of its verdict.json. So one that failed, or that somebody stopped, is known
/// where its folder is gone.
namespace rvbench::bench {

/// What the ledger has of one of its runs. Pointers into that ledger.
struct GoldenLines {
  std::string folder;                  ///< below the root: "GOLDEN/20261127T080000Z"
  const LedgerLine* begun = nullptr;   ///< never null
  const LedgerLine* ended = nullptr;   ///< the last, as a run may be resumed; null: it did not end
};

/// Whether a run is one that the section's golden unit is judged by.
bool is_golden_run(const QualificationSection& section, const std::string& serial,
                   const std::string& plan);

// Of the run in that folder below the root, which is one. Of a run whose begin was not entered, as
// the station was not qualified, the end is not entered either.
// @throws std::system_error, as LedgerPen
void enter_golden_begin(const std::filesystem::path& root, const QualificationSection& section,
                        const std::filesystem::path& run);
void enter_golden_end(const std::filesystem::path& root, const QualificationSection& section,
                      const std::filesystem::path& run);

/// Those on the section's station and kind of rig, in the order in which they began; from the first
/// one on that began at the demand's `since_utc` or later.
std::vector<GoldenLines> golden_lines(const Ledger& ledger, const QualificationSection& section);

}  // namespace rvbench::bench
