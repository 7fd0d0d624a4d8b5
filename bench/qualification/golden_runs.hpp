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
  std::string folder;                 ///< below the root: "GOLDEN/20261127T080000Z"
  std::string plan_sha256;            ///< of the plan's text, with the limits of its own
  const LedgerLine* begun = nullptr;  ///< never null
  const LedgerLine* ended = nullptr;  ///< since it began, or was gone on with; null: it did not end
};

/// Enters that a run begins, or is gone on with, if it is one of the golden unit that its rig file
/// asks for; as the run's start.json and plan.json tell.
/// @param section  null: nothing is asked  @param run  its folder, below the root
/// @param plan_sha256  of the plan's text, without the limits that are in force for it
/// @return why that cannot be; "" if it is done, or if it is no such run
std::string enter_golden_begin(const std::filesystem::path& root,
                               const QualificationSection* section,
                               const std::filesystem::path& run, const std::string& plan_sha256);

/// Likewise that it has come to its end, if its begin was entered: a run that was refused has none.
std::string enter_golden_end(const std::filesystem::path& root, const QualificationSection* section,
                             const std::filesystem::path& run);

/// Those on the section's station and kind of rig, in the order in which they began. With a
/// `since_utc` those after the last that began before it: a clock may have been wrong. Plans of
/// that name may differ.
std::vector<GoldenLines> golden_lines(const Ledger& ledger, const QualificationSection& section);

}  // namespace rvbench::bench
