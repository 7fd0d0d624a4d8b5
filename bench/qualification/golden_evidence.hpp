#pragma once

#include <string>
#include <vector>

#include "bench/qualification/qualification_section.hpp"
#include "bench/result_database.hpp"

namespace rvbench::bench {

/// One indicator of the golden unit, run after run.
struct GoldenChart {
  std::string name;            ///< "acceleration_rms at 1210 rpm, 50 %"
  std::vector<double> values;  ///< of the runs that have it, in the order of time
  bool has_newest = false;     ///< the newest run is among them
};

/// What the result database tells of the golden unit.
struct GoldenEvidence {
  std::string unreadable;    ///< why nothing can be told; empty: it can
  std::vector<RunRow> runs;  ///< of the plan, that were judged (no ERROR, no ABORTED), oldest first
  std::vector<GoldenChart> charts;
};

/// @param database  that holds every run there is, or why there is none
GoldenEvidence golden_evidence(const Result<ResultDatabase>& database,
                               const GoldenUnitDemand& demand);

/// What its runs say against the station, a sentence each; empty: it is as ever.
std::vector<std::string> golden_reasons(const GoldenEvidence& evidence,
                                        const GoldenUnitDemand& demand, const std::string& now_utc);

}  // namespace rvbench::bench
