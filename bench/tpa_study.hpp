#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/kinematics.hpp"
#include "analysis/tpa/ranking_certainty.hpp"
#include "bench/judgement.hpp"
#include "bench/tpa_frfs.hpp"
#include "bench/tpa_histories.hpp"
#include "bench/tpa_methods.hpp"

namespace rvbench::bench {

/// What the first place of a ranking is worth.
enum class LeadWord {
  leads,               ///< validated, and ahead of all others in 95 % of the replicates
  not_sure,            ///< another may be ahead of it
  not_told_apart,      ///< references moved together
  contradicted,        ///< sensors or FRFs contradict each other
  target_unexplained,  ///< the sum of the paths is not what the target shows
  not_validated        ///< what was not fitted to shows something else
};

/// Who leads at one target over one band.
struct BandAnswer {
  analysis::TargetRanking ranking;
  analysis::RankingCertainty certainty;
  LeadWord word = LeadWord::not_validated;
};

/// A joint's reducer, judged because a path of that joint leads.
struct ReducerAnswer {
  TpaReducer reducer;
  analysis::Kinematics kinematics;
  Judgement judgement;
  std::optional<Judgement> after;  ///< of the reducer after the repair
};

/// The targets in the same motion, before and after a repair.
struct RepairAnswer {
  std::string recording;
  Eigen::MatrixXd before, after;          ///< targets x lines: RMS over blocks of the amplitudes
  Eigen::MatrixXd before_rms, after_rms;  ///< targets x bands
};

/// One motion, analysed.
struct MotionAnswer {
  TpaMotion motion;
  analysis::PathContributions contributions;
  std::vector<BandAnswer> answers;  ///< bands x targets, targets of a band in a row
  MethodFindings findings;
  /// If it was asked for, and the rate goes with the lines.
  std::optional<ContributionsOverTime> over_time;
  std::optional<ReducerAnswer> reducer;
  std::string reducer_refusal;  ///< why its recording could not be judged; empty if it was
  std::optional<RepairAnswer> repair;
};

/// All that an analysis of paths came to.
struct TpaStudy {
  TpaProject project;
  TpaFrfs frfs;
  std::vector<MotionAnswer> motions;
  std::string software;
  std::vector<std::pair<std::string, std::string>> hashes;  ///< file, SHA-256
};

/// What may be said of the first path.
/// @param findings, doubts  where references moved together, a sensor changed, FRFs contradict each
///                          other or are off by who knows what, no path is said to lead
/// Errors  none thrown: a score that is not known does not validate. Source  TpaFaultLimits
LeadWord word_of(const analysis::TargetRanking& ranking,
                 const analysis::RankingCertainty& certainty, const MethodFindings& findings,
                 const std::vector<analysis::DirectionDoubt>& doubts,
                 const analysis::LineGrid& grid);

/// Share of the target's power that the sum of the paths explains; NaN where it is silent.
/// Errors  none thrown. Source  of OnBoardValidation::score()
double target_score(const analysis::TargetRanking& ranking);

/// Joints whose paths lead at a target of this motion, each once, in the order of the answers.
/// Units  none. Errors  none thrown. Source  definition
std::vector<std::string> leading_joints(const std::vector<BandAnswer>& answers,
                                        const std::vector<DegreeOfFreedom>& paths);

/// What a repair changed at a target over a band [dB]. Errors  none thrown. Source  definition
double change_dB(const RepairAnswer& repair, Eigen::Index target, Eigen::Index band);

/// RMS over the blocks of each row's amplitude: rows x lines, in the unit of the matrices.
/// Errors  none thrown. Source  definition
Eigen::MatrixXd mean_amplitudes(const analysis::LineMatrices& values);

/// Reads and analyses all that the project names.
/// @param with_time  contributions over time as well, which only the page and histories show
/// @return the study, or why the data is refused: each with file or place
/// @throws Interrupted
std::variant<TpaStudy, TpaRefusal> study_paths(const TpaProject& project, bool with_time,
                                               ProgressBar& bar, const std::stop_token& stop);

}  // namespace rvbench::bench
