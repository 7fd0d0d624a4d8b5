#include "bench/tpa_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

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

// Spectra of an operating record at these sensors, or why there are none.
std::variant<analysis::OperatingSpectra, TpaRefusal> spectra_of(
    const std::string& file, const std::vector<DegreeOfFreedom>& sensors, const TpaFrfs& frfs) {
  const auto read = hal::read_recordings(file);
  if (!read) return TpaRefusal{read.error().where};
  if (read.value().size() != 1) {
    return TpaRefusal{
        fmt::format("{}: holds {} recordings; a motion is one", file, read.value().size())};
  }
  const Recording& record = read.value().front();
  if (!record.status.empty() && record.status != "ok") {
    return TpaRefusal{file + ": " + record.status};
  }
  auto taken = analysis::operating_spectra(record, sensors, grid_of(frfs.matrix));
  if (!taken.spectra) {
    for (std::string& fault : taken.faults) fault.insert(0, file + ": ");
    return std::move(taken.faults);
  }
  if (taken.spectra->unit != frfs.matrix.response_unit) {
    return TpaRefusal{fmt::format("{}: is in \"{}\", the FRFs tell of \"{}\"", file,
                                  taken.spectra->unit, frfs.matrix.response_unit)};
  }
  return std::move(*taken.spectra);
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

class Study {
 public:
  Study(const TpaProject& project, const TpaFrfs& frfs, ProgressBar& bar, std::stop_token stop)
      : project_(project),
        frfs_(frfs),
        roles_(project.indicators, project.targets, project.validation),
        rule_(analysis::find_rule(project.rule)->rule),
        bar_(bar),
        stop_(std::move(stop)) {}

  std::variant<MotionAnswer, TpaRefusal> answer(const TpaMotion& motion) {
    show(motion, "spectra");
    auto taken = spectra_of(motion.recording, sensors_of(project_), frfs_);
    if (auto* refusal = std::get_if<TpaRefusal>(&taken)) return std::move(*refusal);
    const auto& operating = std::get<0>(taken);
    show(motion, "forces");
    MotionAnswer answer{motion,
                        analysis::matrix_inverse_contributions(frfs_.matrix, operating, roles_,
                                                               rule_, frfs_.coherent.is_used),
                        {},
                        {},
                        {},
                        {}};
    add_faults(operating, answer);
    show(motion, "certainty");
    add_answers(operating, answer);
    if (auto refusal = add_repair(answer)) return std::move(*refusal);
    if (auto refusal = add_reducer(answer)) return std::move(*refusal);
    ++done_;
    return answer;
  }

 private:
  void show(const TpaMotion& motion, const char* doing) {
    end_if_stopped(stop_);
    bar_.show("paths", double(done_) / double(project_.motions.size()), motion.name + ": " + doing);
  }

  void add_faults(const analysis::OperatingSpectra& operating, MotionAnswer& answer) const {
    answer.faults = analysis::faults_before_inversion(
        Index(roles_.indicators().size()), frfs_.matrix.values.columns, frfs_.coherent.is_used);
    std::ranges::move(
        analysis::faults_of_inversion(frfs_.matrix, operating, roles_, answer.contributions),
        std::back_inserter(answer.faults));
  }

  void add_answers(const analysis::OperatingSpectra& operating, MotionAnswer& answer) const {
    const auto rankings = analysis::rank_contributions(answer.contributions, project_.bands);
    const auto certainties =
        analysis::ranking_certainty(frfs_.matrix, operating, roles_, rule_, frfs_.coherent.is_used,
                                    rankings, project_.resampling);
    for (std::size_t i = 0; i < rankings.size(); ++i) {
      answer.answers.push_back({rankings[i], certainties[i], word_of(rankings[i], certainties[i])});
    }
  }

  std::optional<TpaRefusal> add_repair(MotionAnswer& answer) {
    if (answer.motion.after.empty()) return std::nullopt;
    show(answer.motion, "after the repair");
    auto taken = spectra_of(answer.motion.after, project_.targets, frfs_);
    if (auto* refusal = std::get_if<TpaRefusal>(&taken)) return std::move(*refusal);
    const analysis::LineGrid grid = grid_of(frfs_.matrix);
    RepairAnswer repair{answer.motion.after,
                        mean_amplitudes(answer.contributions.measured_targets),
                        mean_amplitudes(std::get<0>(taken).values),
                        {},
                        {}};
    repair.before_rms = band_rms(repair.before, grid, project_.bands);
    repair.after_rms = band_rms(repair.after, grid, project_.bands);
    answer.repair = std::move(repair);
    return std::nullopt;
  }

  // One recording may stand for several motions: it is judged once.
  std::optional<TpaRefusal> add_reducer(MotionAnswer& answer) {
    const auto& reducer = answer.motion.reducer;
    if (!reducer) return std::nullopt;
    const auto joints = leading_joints(answer.answers, answer.contributions.paths);
    if (std::ranges::find(joints, reducer->joint) == joints.end()) return std::nullopt;
    const std::array key{reducer->recording, reducer->after, reducer->kinematics};
    if (!judged_.contains(key)) {
      show(answer.motion, "reducer");
      auto judged = judge_reducer(*reducer, stop_);
      if (auto* why = std::get_if<std::string>(&judged)) return TpaRefusal{*why};
      judged_.emplace(key, std::get<0>(std::move(judged)));
    }
    answer.reducer = judged_.at(key);
    return std::nullopt;
  }

  const TpaProject& project_;
  const TpaFrfs& frfs_;
  analysis::SensorRoles roles_;
  analysis::RegularisationRule rule_;
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
                 const analysis::RankingCertainty& certainty) {
  if (!(ranking.validation_score >= analysis::TpaFaultLimits{}.least_score)) {
    return LeadWord::not_validated;
  }
  return certainty.led.front() >= sure ? LeadWord::leads : LeadWord::not_sure;
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

Eigen::MatrixXd mean_amplitudes(const analysis::LineMatrices& values) {
  Eigen::MatrixXd amplitudes(values.rows, values.lines);
  for (Index line = 0; line < values.lines; ++line) {
    amplitudes.col(line) = values[line].cwiseAbs2().rowwise().mean().cwiseSqrt();
  }
  return amplitudes;
}

std::variant<TpaStudy, TpaRefusal> study_paths(const TpaProject& project, ProgressBar& bar,
                                               const std::stop_token& stop) {
  auto frfs = read_tpa_frfs(project, bar, stop);
  if (auto* refusal = std::get_if<TpaRefusal>(&frfs)) return std::move(*refusal);
  TpaStudy study{project, std::get<0>(std::move(frfs)), {}, software_version(), {}};
  if (analysis::find_rule(project.rule)->needs_noise && study.frfs.matrix.noise.size() == 0) {
    return TpaRefusal{"FRFs: " + project.rule +
                      " needs their noise, and the bands have too few lines to tell it"};
  }
  Study motions(study.project, study.frfs, bar, stop);
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
