#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "analysis/kinematics.hpp"
#include "bench/judgement.hpp"
#include "bench/progress_bar.hpp"
#include "hal/recording_file.hpp"
#include "hal/rig.hpp"
#include "sequences/plan.hpp"

namespace rvbench::bench {

/// Begins a recording.
using RecordingMaker = std::function<Result<std::unique_ptr<hal::RecordingWriter>>(
    const std::filesystem::path& file, const hal::RecordingLayout& layout)>;

/// As RecordingWriter::create() does.
Result<std::unique_ptr<hal::RecordingWriter>> make_recording(const std::filesystem::path& file,
                                                             const hal::RecordingLayout& layout);

/// How a plan is recorded on a rig.
/// Units  of the rig. Errors  none thrown. Source  the plan's points, the rig's devices
hal::RecordingLayout layout_of(const sequences::TestPlan& plan, const hal::Rig& rig);

/// What one acceptance test works with.
struct Acceptance {
  const sequences::TestPlan& plan;
  analysis::Kinematics kinematics;  ///< with the plan's limits
  std::filesystem::path folder;     ///< of the run, with plan.json and rig.json in it
  RunFacts facts;                   ///< what is known before the start
  std::string twin = {};            ///< plant that stands for what the rig turns; "" on a simulated
                                    ///< rig, which is its own
  std::vector<std::string> warnings = {};  ///< of the rig file; they go into the log
  std::string lost_points = {};            ///< what an earlier part of the run has measured in vain
  std::optional<Ending> refusal = {};      ///< why nothing may be turned: the station may not judge
  bool with_report = true;                 ///< report.html, which can be made later as well
  RecordingMaker begin_recording = make_recording;  ///< another watches what is recorded
};

/// Measures and records, judges what was recorded, and leaves the run folder complete:
/// recording, log.jsonl, verdict.json, junit.xml, report.html, SHA256SUMS. In a folder that holds
/// recordings already it goes on at the next point; nothing is turned if no point is left. Whatever
/// happens to the bench is in the judgement's ending, and also if the results cannot be written.
/// One that is refused turns and connects nothing, and tells so in all of these files.
/// How a run that was measured to its end differs from its twin is an event, and changes no ending.
///
/// With RunFacts::must_exit a thread may go on to use the rig and the bar: neither may be
/// destroyed, nor may anybody wait for what that thread holds, as the lock of standard error.
///
/// A run that its log or one of these files does not tell ends as an ERROR.
///
/// @throws std::system_error, before anything turns, if log.jsonl cannot be opened, or the
///         SHA256SUMS of an earlier part cannot be removed
Judgement run_acceptance(Acceptance acceptance, hal::Rig& rig, ProgressBar& bar,
                         std::stop_token stop);

}  // namespace rvbench::bench
