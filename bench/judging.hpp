#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"
#include "bench/judgement.hpp"
#include "hal/config_reader.hpp"
#include "hal/types/recording.hpp"
#include "sequences/plan.hpp"

namespace rvbench::bench {

/// Every part whose damage has a signature, once.
std::vector<std::string> parts_of(const analysis::Kinematics& kinematics);

/// The kinematics with the plan's limits on "modulation_depth" in place of its own: of each part
/// the strictest of those that are about it.
/// Units  of depths: 1. Errors  none thrown. Source  the plan
analysis::Kinematics with_limits(analysis::Kinematics kinematics,
                                 const std::vector<sequences::Limit>& limits);

/// The examinations of all points that were measured.
/// Errors  none thrown. Source  judge_point()
std::vector<analysis::Examination> examined_points(const Judgement& judgement);

/// The kinematics with the gear ratio and the rated torque of the plan in place of its own.
/// Units  N·m at the output. Errors  none thrown. Source  the plan
analysis::Kinematics of_specimen(analysis::Kinematics kinematics,
                                 const sequences::Specimen& specimen);

/// Limits that no run of the plan on that machine can be held against, as faults at "/limits".
/// Errors  none thrown. Source  limits_on_unknown_parts(), sequences::limits_without_points()
std::vector<hal::ConfigFault> limits_out_of_place(const std::vector<sequences::Limit>& limits,
                                                  const sequences::TestPlan& plan,
                                                  const analysis::Kinematics& kinematics);

/// Limits on parts, bands, orders or meshes that the machine does not have, as faults of the plan:
/// never found, such a part would always be within its limit.
/// Errors  none thrown: each is a fault in the answer. Source  the names of the kinematics
std::vector<hal::ConfigFault> limits_on_unknown_parts(const std::vector<sequences::Limit>& limits,
                                                      const analysis::Kinematics& kinematics);

/// Examines one record. One whose status is not "ok" is not examined: it is listed, and invalid.
/// Units   those of analysis::examine(). Errors  none thrown for what was measured, as there
/// Source  analysis::examine()
JudgedPoint judge_point(const Recording& record, const analysis::Kinematics& kinematics,
                        const analysis::ExamineOptions& options);

/// Draws the conclusion from judgement.points: diagnosis, limits, and the ending.
/// @param measured  how the sequence itself ended; the graver of both becomes the ending
/// Errors  none thrown: what cannot be judged ends INVALID, with the reason
/// Source  analysis::conclude() and check_of(); which ending is the graver: README, exit codes
void conclude(Judgement& judgement, const analysis::Kinematics& kinematics,
              const std::vector<sequences::Limit>& limits, const Ending& measured);

/// Holds other limits against what was concluded: limits and ending are drawn anew, the diagnosis
/// stands. Of limits that bound depths as those did which it was concluded by.
/// Errors  none thrown. Source  check_of()
void hold_against(Judgement& judgement, const std::vector<sequences::Limit>& limits,
                  const Ending& measured);

/// After conclude(): where no line of the machine's shaft is in the data, or its gear train's
/// orders fit the lines no better than chance does, the judgement ends INVALID, with a quality
/// note: orders that were looked for at a wrong speed, or of another machine, are silent, too. The
/// note names the speed at which the lines would fit, if one stands out. Errors  none thrown.
/// Source  shows_shaft(), gear_train_fit()
void demand_confirmation(Judgement& judgement, const analysis::Kinematics& kinematics);

}  // namespace rvbench::bench
