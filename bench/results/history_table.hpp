#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/console.hpp"
#include "bench/result_database.hpp"

namespace rvbench::bench {

// What is told of the runs of a folder.
struct History {
  std::vector<RunRow> runs;
  std::map<std::string, std::vector<JudgementRow>> later;  ///< by folder
  std::map<std::string, RunValue> values;                  ///< likewise, of --indicator
};

/// {"runs": [...]}: a row each, what it was judged to be then, and "rejudged", later judgements.
std::string history_to_json(const History& history);

/// A line per run, and one below it per later judgement. On a terminal a plan is cut and a reason
/// goes on below, so that they are no wider than it but for a serial, which stays whole.
void print_history(Console& console, const History& history);

}  // namespace rvbench::bench
