#include "bench/tpa_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "analysis/frf/signed_axis.hpp"
#include "analysis/tpa/operational_paths.hpp"
#include "bench/sha256.hpp"
#include "bench/software_version.hpp"
#include "bench/stop_on_signal.hpp"
#include "bench/tpa_hits.hpp"
#include "bench/tpa_reducer.hpp"
#include "hal/formats/read_recordings.hpp"

namespace rvbench::bench {
namespace {

using Eigen::Index;

constexpr double sure = 0.95;  // of the replicates

struct Operation {
  analysis::OperatingSpectra spectra;
  Recording recording;
};

// An operating record at these sensors, or why there is none.
std::variant<Operation, TpaRefusal> operation_of(const std::string& file,
                                                 const std::vector<DegreeOfFreedom>& sensors,
                                                 TpaFrfs& frfs) {
  auto read = hal::read_recordings(file);
  if (!read) return TpaRefusal{read.error().where};
  std::vector<Recording> recordings = std::move(read).value();
  if (recordings.size() != 1) {
    return TpaRefusal{
        fmt::format("{}: holds {} recordings; a motion is one", file, recordings.size())};
  }
  Recording& record = recordings.front();
  if (!record.status.empty() && record.status != "ok") {
    return TpaRefusal{file + ": " + record.status};
  }
  auto taken = analysis::operating_spectra(record, sensors, grid_of(frfs.matrix));
  if (!taken.spectra) {
    for (std::string& fault : taken.faults) fault.insert(0, file + ": ");
    return std::move(taken.faults);
  }
  if (frfs.matrix.values.rows == 0 && frfs.matrix.response_unit.empty()) {
    frfs.matrix.response_unit = taken.spectra->unit;  // of the first motion
  }
  if (taken.spectra->unit != frfs.matrix.response_unit) {
    return TpaRefusal{
        fmt::format("{}: is in \"{}\", {} \"{}\"", file, taken.spectra->unit,
                    frfs.matrix.values.rows == 0 ? "the first motion in" : "the FRFs tell of",
                    frfs.matrix.response_unit)};
  }
  return Operation{std::move(*taken.spectra), std::move(record)};
}

Eigen::MatrixXd band_rms(const Eigen::MatrixXd& amplitudes, const analysis::LineGrid& grid,
                         const std::vector<analysis::TpaBand>& bands) {
  Eigen::MatrixXd rms(amplitudes.rows(), Index(bands.size()));
  for (std::size_t band = 0; band < bands.size(); ++band) {
    Eigen::VectorXd power = Eigen::VectorXd::Zero(amplitudes.rows());
    for (Index line = 0; line < grid.lines; ++line) {
      if (analysis::holds(bands[band], grid, line)) power += amplitudes.col(line).cwiseAbs2();
    }
    rms.col(Index(band)) = (analysis::mean_square_per_power * power).cwiseSqrt();
  }
  return rms;
}

// What operation is recorded by: sensors, and both sides of mounts.
std::vector<DegreeOfFreedom> operating_places(const TpaProject& project) {
  std::vector<DegreeOfFreedom> all = sensors_of(project);
  if (project.active.empty()) return all;
  for (const auto* side : {&project.active, &project.paths}) {
    for (const DegreeOfFreedom& place : *side) {
      if (std::ranges::find(all, place) == all.end()) all.push_back(place);
    }
  }
  return all;
}

// How the FRFs might have come out otherwise; set right again where they were.
analysis::FrfDraw draw_of(const TpaFrfs& frfs) {
  auto draw = frfs.deviations.empty() ? analysis::draws_within_variances(frfs.measured)
                                      : analysis::draws_of_hits(frfs.measured, frfs.deviations);
  return frfs.alignment.is_used ? analysis::aligned_draws(std::move(draw)) : draw;
}

// Nothing can be drawn of a path that was hit once, nor of FRFs without hits and coherence.
void add_unknown_errors(const TpaFrfs& frfs, std::vector<analysis::TpaFault>& faults) {
  const auto add = [&](std::string where, std::string reason) {
    faults.push_back(
        {analysis::TpaFaultKind::frf_errors_unknown, std::move(where), std::move(reason)});
  };
  if (frfs.deviations.empty() && frfs.matrix.variances.size() == 0) {
    add("FRFs",
        "their files do not tell coherence and number of averages: how far they are off is not "
        "known, and no path can be said to lead");
  }
  for (std::size_t i = 0; i < frfs.deviations.size(); ++i) {
    if (frfs.deviations[i].size() > 1) continue;
    add(analysis::name_of(frfs.matrix.excitations[i]),
        "one good hit does not tell how far it is off: no path can be said to lead");
  }
}

class Study {
 public:
  Study(const TpaProject& project, TpaFrfs& frfs, bool with_time, ProgressBar& bar,
        std::stop_token stop)
      : project_(project),
        frfs_(frfs),
        with_time_(with_time),
        method_(tpa_method(project.method)),
        bar_(bar),
        stop_(std::move(stop)) {}

  std::variant<MotionAnswer, TpaRefusal> answer(const TpaMotion& motion) {
    show(motion, "spectra");
    auto taken = operation_of(motion.recording, operating_places(project_), frfs_);
    if (auto* refusal = std::get_if<TpaRefusal>(&taken)) return std::move(*refusal);
    auto& [spectra, recording] = std::get<0>(taken);
    const Index blocks = spectra.values.columns;
    auto made = method_.make(project_, frfs_, std::move(spectra));
    if (const auto* why = std::get_if<std::string>(&made)) {
      return TpaRefusal{motion.recording + ": " + *why};
    }
    show(motion, "forces");
    MotionAnswer answer = analysed(motion, *std::get<0>(made), blocks);
    if (with_time_) {
      show(motion, "histories");
      answer.over_time = contributions_over_time(answer.contributions, recording);
    }
    if (auto refusal = add_repair(answer)) return std::move(*refusal);
    add_reducer(answer);
    ++done_;
    return answer;
  }

 private:
  void show(const TpaMotion& motion, const char* doing) {
    end_if_stopped(stop_);
    bar_.show("paths", double(done_) / double(project_.motions.size()), motion.name + ": " + doing);
  }

  MotionAnswer analysed(const TpaMotion& motion, const TpaMethod& method, Index blocks) {
    std::vector<Index> all(static_cast<std::size_t>(blocks));
    std::iota(all.begin(), all.end(), 0);
    MotionAnswer answer{motion, method.contributions(frfs_.matrix, all, 0), {}, {}, {}, {}, {}, {}};
    answer.findings = method.findings(answer.contributions);
    if (method_.needs_frfs) add_unknown_errors(frfs_, answer.findings.faults);
    show(motion, "certainty");
    const auto anew = [&](const analysis::FrfMatrix& frfs, const std::vector<Index>& drawn) {
      return method.contributions(frfs, drawn, 1);
    };
    const auto rankings = analysis::rank_contributions(answer.contributions, project_.bands);
    const auto certainties =
        analysis::ranking_certainty(draw_of(frfs_), blocks, anew, rankings, project_.resampling);
    for (std::size_t i = 0; i < rankings.size(); ++i) {
      answer.answers.push_back({rankings[i], certainties[i],
                                word_of(rankings[i], certainties[i], answer.findings, frfs_.doubts,
                                        answer.contributions.grid)});
    }
    return answer;
  }

  std::optional<TpaRefusal> add_repair(MotionAnswer& answer) {
    if (answer.motion.after.empty()) return std::nullopt;
    show(answer.motion, "after the repair");
    auto taken = operation_of(answer.motion.after, project_.targets, frfs_);
    if (auto* refusal = std::get_if<TpaRefusal>(&taken)) return std::move(*refusal);
    const analysis::LineGrid grid = grid_of(frfs_.matrix);
    RepairAnswer repair{answer.motion.after,
                        mean_amplitudes(answer.contributions.measured_targets),
                        mean_amplitudes(std::get<0>(taken).spectra.values),
                        {},
                        {}};
    repair.before_rms = band_rms(repair.before, grid, project_.bands);
    repair.after_rms = band_rms(repair.after, grid, project_.bands);
    answer.repair = std::move(repair);
    return std::nullopt;
  }

  // One recording may stand for several motions: it is judged once.
  void add_reducer(MotionAnswer& answer) {
    const auto& reducer = answer.motion.reducer;
    if (!reducer) return;
    const auto joints = leading_joints(answer.answers, answer.contributions.paths);
    if (std::ranges::find(joints, reducer->joint) == joints.end()) return;
    const std::array key{reducer->recording, reducer->after, reducer->kinematics};
    if (!judged_.contains(key)) {
      show(answer.motion, "reducer");
      auto judged = judge_reducer(*reducer, stop_);
      if (auto* why = std::get_if<std::string>(&judged)) {
        answer.reducer_refusal = *why;
        return;
      }
      judged_.emplace(key, std::get<0>(std::move(judged)));
    }
    answer.reducer = judged_.at(key);
  }

  const TpaProject& project_;
  TpaFrfs& frfs_;
  bool with_time_;
  const NamedTpaMethod& method_;
  ProgressBar& bar_;
  std::stop_token stop_;
  std::size_t done_ = 0;
  std::map<std::array<std::string, 3>, ReducerAnswer> judged_;
};

std::vector<std::pair<std::string, std::string>> hashes_of(const TpaProject& project) {
  std::vector<std::string> files = project.frf_files;
  if (project.hammer) {
    for (const TpaHits& hits : project.hammer->hits) files.push_back(hits.file);
  }
  for (const TpaMotion& motion : project.motions) {
    files.push_back(motion.recording);
    if (!motion.after.empty()) files.push_back(motion.after);
    if (motion.reducer) files.push_back(motion.reducer->recording);
    if (motion.reducer && !motion.reducer->after.empty()) files.push_back(motion.reducer->after);
  }
  std::vector<std::pair<std::string, std::string>> hashes;
  std::set<std::string> known;
  for (const std::string& file : files) {
    if (!known.insert(file).second) continue;
    if (const auto hash = sha256_of_file(file)) hashes.emplace_back(file, *hash);
  }
  return hashes;
}

}  // namespace

LeadWord word_of(const analysis::TargetRanking& ranking,
                 const analysis::RankingCertainty& certainty, const MethodFindings& findings,
                 const std::vector<analysis::DirectionDoubt>& doubts,
                 const analysis::LineGrid& grid) {
  if (!(ranking.validation_score >= analysis::TpaFaultLimits{}.least_score)) {
    return LeadWord::not_validated;
  }
  if (!(target_score(ranking) >= analysis::TpaFaultLimits{}.least_score)) {
    return LeadWord::target_unexplained;
  }
  const Eigen::VectorXd& ways = findings.ways;
  Index lines = 0, together = 0;
  for (Index line = 0; line < ways.size(); ++line) {
    if (!analysis::holds(ranking.band, grid, line)) continue;
    ++lines;
    if (!analysis::tells_all(ways[line], Index(ranking.paths.size()))) ++together;
  }
  if (2 * together > lines) return LeadWord::not_told_apart;
  const auto has = [&](analysis::TpaFaultKind kind) {
    return std::ranges::find(findings.faults, kind, &analysis::TpaFault::kind) !=
           findings.faults.end();
  };
  using Kind = analysis::TpaFaultKind;
  if (!doubts.empty() || has(Kind::sign_reversed) || has(Kind::directions_swapped)) {
    return LeadWord::contradicted;
  }
  if (has(Kind::frf_errors_unknown)) return LeadWord::not_sure;
  return certainty.led.front() >= sure ? LeadWord::leads : LeadWord::not_sure;
}

double target_score(const analysis::TargetRanking& ranking) {
  double in_common = 0;
  for (const analysis::BandContribution& path : ranking.paths) in_common += path.coherent_share;
  const double synthesised = ranking.synthesised_rms / ranking.measured_rms;
  return 2 * in_common - synthesised * synthesised;
}

std::vector<std::string> leading_joints(const std::vector<BandAnswer>& answers,
                                        const std::vector<DegreeOfFreedom>& paths) {
  std::vector<std::string> joints;
  for (const BandAnswer& answer : answers) {
    if (answer.word != LeadWord::leads) continue;
    const std::string joint = joint_of(paths[std::size_t(answer.ranking.paths.front().path)]);
    if (std::ranges::find(joints, joint) == joints.end()) joints.push_back(joint);
  }
  return joints;
}

double change_dB(const RepairAnswer& repair, Index target, Index band) {
  return 20 * std::log10(repair.after_rms(target, band) / repair.before_rms(target, band));
}

Eigen::MatrixXd mean_amplitudes(const analysis::LineMatrices& values) {
  Eigen::MatrixXd amplitudes(values.rows, values.lines);
  for (Index line = 0; line < values.lines; ++line) {
    amplitudes.col(line) = values[line].cwiseAbs2().rowwise().mean().cwiseSqrt();
  }
  return amplitudes;
}

std::variant<TpaStudy, TpaRefusal> study_paths(const TpaProject& project, bool with_time,
                                               ProgressBar& bar, const std::stop_token& stop) {
  auto frfs = read_tpa_frfs(project, bar, stop);
  if (auto* refusal = std::get_if<TpaRefusal>(&frfs)) return std::move(*refusal);
  TpaStudy study{project, std::get<0>(std::move(frfs)), {}, software_version(), {}};
  const bool asks_noise = analysis::find_rule(project.rule)->needs_noise;
  if (asks_noise && study.frfs.matrix.noise.size() == 0) {
    return TpaRefusal{"FRFs: " + project.rule +
                      " needs their noise, and the bands have too few lines to tell it"};
  }
  Study motions(study.project, study.frfs, with_time, bar, stop);
  for (const TpaMotion& motion : study.project.motions) {
    auto answer = motions.answer(motion);
    if (auto* refusal = std::get_if<TpaRefusal>(&answer)) return std::move(*refusal);
    study.motions.push_back(std::get<0>(std::move(answer)));
  }
  bar.clear();
  study.hashes = hashes_of(project);
  return study;
}

}  // namespace rvbench::bench
