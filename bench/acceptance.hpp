#pragma once

#include <filesystem>
#include <stop_token>
#include <string>

#include "analysis/kinematics.hpp"
#include "bench/progress_bar.hpp"
#include "bench/run_folder.hpp"
#include "hal/rig.hpp"
#include "sequences/plan.hpp"

namespace rvbench::bench {

/// What one acceptance test works with.
struct Acceptance {
  const sequences::TestPlan& plan;
  analysis::Kinematics kinematics;  ///< with the plan's limits
  std::filesystem::path folder;     ///< of the run, with plan.json and rig.json in it
  RunFacts facts;                   ///< what is known before the start
  std::string twin = {};            ///< plant that stands for what the rig turns; "" on a simulated
                                    ///< rig, which is its own
};

/// Measures and records, judges what was recorded, and leaves the run folder complete:
/// recording, log.jsonl, verdict.json, junit.xml, report.html, SHA256SUMS. In a folder that holds
/// recordings already it goes on at the next point; nothing is turned if no point is left. Whatever
/// happens to the bench is in the judgement's ending, and also if the results cannot be written.
/// How a run that was measured to its end differs from its twin is an event, and changes no ending.
///
/// @throws std::system_error, before anything turns, if log.jsonl cannot be opened
Judgement run_acceptance(Acceptance acceptance, hal::Rig& rig, ProgressBar& bar,
                         std::stop_token stop);

}  // namespace rvbench::bench
