#pragma once

#include <string>
#include <vector>

#include "bench/ledger.hpp"
#include "bench/qualification/qualification_section.hpp"
#include "bench/result_database.hpp"

namespace rvbench::bench {

/// One indicator of the golden unit, run after run.
struct GoldenChart {
  std::string name;            ///< "acceleration_rms at 1210 rpm, 50 %"
  std::vector<double> values;  ///< of the runs that have it, in their order
  bool has_newest = false;     ///< the newest run is among them
};

/// What ledger, folders and result database tell of the golden unit.
struct GoldenEvidence {
  std::string unreadable;  ///< why nothing can be told; empty: it can
  /// Of the plan, on this station, that were judged (no ERROR, no ABORTED), in their order.
  std::vector<RunRow> runs;
  std::string newest_without_verdict;  ///< and what is to be done; empty: the newest was judged
  std::vector<std::string> doubts;     ///< of those whose verdict nobody knows any more
  int of_another_plan = 0;             ///< runs of a plan of that name, but with another text
  std::vector<GoldenChart> charts;
};

/// @param database  that holds every run there is, or why there is none
/// @param ledger    of the same folder, read before that: which runs there were, in their order
/// @param section   with a golden unit: runs on another station or kind of rig do not count, nor
///                  those on a rig whose file did not name that unit, nor those of another plan
///                  than the first one's, whatever its name
GoldenEvidence golden_evidence(const Result<ResultDatabase>& database, const Ledger& ledger,
                               const QualificationSection& section);

/// What its runs say against the station, a sentence each; empty: it is as ever.
std::vector<std::string> golden_reasons(const GoldenEvidence& evidence,
                                        const GoldenUnitDemand& demand, const std::string& now_utc);

}  // namespace rvbench::bench
