#include "bench/tpa_json.hpp"

#include <nlohmann/json.hpp>

#include "analysis/frf/signed_axis.hpp"
#include "bench/examination_json.hpp"
#include "bench/json_text.hpp"
#include "bench/tpa_text.hpp"
#include "hal/json_object.hpp"
#include "hal/types/units.hpp"

namespace rvbench::bench {
namespace {

using Eigen::Index;
using nlohmann::ordered_json;
using Places = std::vector<DegreeOfFreedom>;

ordered_json numbers(const Eigen::VectorXd& values) {
  ordered_json json = ordered_json::array();
  for (const double value : values) json.push_back(finite_or_null(value));
  return json;
}

ordered_json place_json(const DegreeOfFreedom& place) {
  return hal::json_object({{"point", place.point}, {"direction", place.direction}});
}

ordered_json places_json(const Places& places) {
  ordered_json json = ordered_json::array();
  for (const DegreeOfFreedom& place : places) json.push_back(place_json(place));
  return json;
}

ordered_json band_json(const analysis::TpaBand& band) {
  return hal::json_object({{"from_Hz", band.first_Hz}, {"to_Hz", band.last_Hz}});
}

const char* word_text(LeadWord word) {
  switch (word) {
    case LeadWord::leads: return "leads";
    case LeadWord::not_sure: return "not_sure";
    case LeadWord::not_told_apart: return "not_told_apart";
    case LeadWord::contradicted: return "contradicted";
    case LeadWord::target_unexplained: return "target_unexplained";
    case LeadWord::not_validated: return "not_validated";
  }
  return "";
}

ordered_json path_json(std::size_t rank, const BandAnswer& answer, const Places& paths) {
  const analysis::BandContribution& path = answer.ranking.paths[rank];
  const analysis::Interval95& interval = answer.certainty.rms[rank];
  return hal::json_object(
      {{"path", path_name(path.path, paths)},
       {"rms", finite_or_null(path.rms)},
       {"interval95", {finite_or_null(interval.low), finite_or_null(interval.high)}},
       {"phase_deg", finite_or_null(path.phase_rad / units::degree_rad)},
       {"coherent_share", finite_or_null(path.coherent_share)}});
}

ordered_json answer_json(const BandAnswer& answer, const MotionAnswer& motion) {
  const auto& [ranking, certainty, word] = answer;
  const Places& paths = motion.contributions.paths;
  ordered_json json = hal::json_object(
      {{"target", target_name(ranking.target, motion.contributions.targets)},
       {"band", band_json(ranking.band)},
       {"word", word_text(word)},
       {"leader", nullptr},
       {"sentence", answer_text(answer, paths)},
       {"leader_led", finite_or_null(certainty.led.front())},
       {"order_held", certainty.order_held.empty() ? ordered_json(nullptr)
                                                   : finite_or_null(certainty.order_held.front())},
       {"validation_score", finite_or_null(ranking.validation_score)},
       {"target_score", finite_or_null(target_score(ranking))},
       {"measured_rms", finite_or_null(ranking.measured_rms)},
       {"synthesised_rms", finite_or_null(ranking.synthesised_rms)},
       {"lines", ranking.lines},
       {"lines_left_out", ranking.lines_left_out},
       {"paths", ordered_json::array()}});
  if (word == LeadWord::leads) json["leader"] = path_name(ranking.paths.front().path, paths);
  for (std::size_t i = 0; i < ranking.paths.size(); ++i) {
    json["paths"].push_back(path_json(i, answer, paths));
  }
  return json;
}

ordered_json judgement_json(const Judgement& judgement) {
  ordered_json json = hal::json_object({{"verdict", rvbench::to_string(judgement.ending.outcome)},
                                        {"reason", judgement.ending.reason}});
  json.update(json_of(judgement.diagnosis));
  return json;
}

ordered_json reducer_json(const ReducerAnswer& answer) {
  ordered_json json = hal::json_object({{"joint", answer.reducer.joint},
                                        {"recording", answer.reducer.recording},
                                        {"machine", answer.kinematics.machine}});
  json.update(judgement_json(answer.judgement));
  json["after"] = nullptr;
  if (answer.after) {
    json["after"] = hal::json_object({{"recording", answer.reducer.after}});
    json["after"].update(judgement_json(*answer.after));
  }
  return json;
}

ordered_json repair_json(const MotionAnswer& motion, const std::vector<analysis::TpaBand>& bands) {
  const RepairAnswer& repair = *motion.repair;
  ordered_json json =
      hal::json_object({{"recording", repair.recording}, {"changes", ordered_json::array()}});
  for (std::size_t band = 0; band < bands.size(); ++band) {
    for (Index target = 0; target < repair.before_rms.rows(); ++target) {
      const double before = repair.before_rms(target, Index(band));
      const double after = repair.after_rms(target, Index(band));
      json["changes"].push_back(hal::json_object(
          {{"target", target_name(target, motion.contributions.targets)},
           {"band", band_json(bands[band])},
           {"before_rms", finite_or_null(before)},
           {"after_rms", finite_or_null(after)},
           {"change_dB", finite_or_null(change_dB(repair, target, Index(band)))}}));
    }
  }
  return json;
}

ordered_json parameters_json(const analysis::MountParameters& parameters) {
  return hal::json_object({{"stiffness_N_m", finite_or_null(parameters.stiffness_N_m)},
                           {"damping_N_s_m", finite_or_null(parameters.damping_N_s_m)},
                           {"mass_kg", finite_or_null(parameters.mass_kg)}});
}

void add_findings(const MethodFindings& findings, ordered_json& json) {
  json["halves_disagree_by"] = finite_or_null(findings.disagreement);
  json["mounts"] = ordered_json::array();
  for (const MountAnswer& mount : findings.mounts) {
    json["mounts"].push_back(
        hal::json_object({{"path", place_json(mount.path)},
                          {"found", parameters_json(mount.found)},
                          {"standard_errors", parameters_json(mount.deviations)}}));
  }
  json["mounts_score"] = finite_or_null(findings.mounts_score);
  json["independent_ways"] = numbers(findings.ways);
}

ordered_json motion_json(const MotionAnswer& motion, const TpaStudy& study) {
  ordered_json kept = ordered_json::array();
  for (const analysis::Regularisation& rule : motion.contributions.rules) kept.push_back(rule.kept);
  ordered_json json = hal::json_object(
      {{"name", motion.motion.name},
       {"recording", motion.motion.recording},
       {"sentence", motion_sentence(motion)},
       {"validation_score", finite_or_null(motion.contributions.validation.score())},
       {"answers", ordered_json::array()},
       {"faults", ordered_json::array()},
       {"condition_numbers", numbers(motion.contributions.conditions)},
       {"kept_singular_values", kept},
       {"reducer", nullptr},
       {"repair", nullptr}});
  for (const BandAnswer& answer : motion.answers) {
    json["answers"].push_back(answer_json(answer, motion));
  }
  add_findings(motion.findings, json);
  for (const analysis::TpaFault& fault : motion.findings.faults) {
    json["faults"].push_back(hal::json_object(
        {{"kind", to_string(fault.kind)}, {"where", fault.where}, {"reason", fault.reason}}));
  }
  if (motion.reducer) json["reducer"] = reducer_json(*motion.reducer);
  json["reducer_refusal"] = motion.reducer_refusal;
  if (motion.repair) json["repair"] = repair_json(motion, study.project.bands);
  return json;
}

ordered_json frfs_json(const TpaFrfs& frfs) {
  ordered_json json = hal::json_object(
      {{"first_Hz", frfs.matrix.first_Hz},
       {"step_Hz", frfs.matrix.step_Hz},
       {"lines", frfs.matrix.values.lines},
       {"lines_left_out", frfs.coherent.left_out},
       {"hits", frfs.hits},
       {"rejected_hits", ordered_json::array()},
       {"aligned", frfs.alignment.is_used},
       {"largest_turn_deg", finite_or_null(frfs.alignment.largest_turn_rad() / units::degree_rad)},
       {"asymmetry_before", finite_or_null(frfs.alignment.asymmetry_before)},
       {"asymmetry_after", finite_or_null(frfs.alignment.asymmetry_after)},
       {"doubts", ordered_json::array()},
       {"notes", frfs.matrix.notes}});
  for (const RejectedHit& hit : frfs.rejected) {
    json["rejected_hits"].push_back(
        hal::json_object({{"source", hit.source}, {"reason", hit.reason}}));
  }
  for (const analysis::DirectionDoubt& doubt : frfs.doubts) {
    json["doubts"].push_back(
        hal::json_object({{"where", analysis::name_of(doubt.place)}, {"reason", doubt.reason}}));
  }
  return json;
}

ordered_json method_json(const TpaProject& project) {
  return hal::json_object(
      {{"method", project.method},
       {"how", tpa_method(project.method).how},
       {"rule", project.rule},
       {"least_coherence", project.least_coherence},
       {"replicates", project.resampling.replicates},
       {"seed", project.resampling.seed},
       {"leads", "ahead of all others in 95 % of the replicates, where validation is at least " +
                     std::to_string(analysis::TpaFaultLimits{}.least_score).substr(0, 3)}});
}

}  // namespace

std::string study_to_json(const TpaStudy& study) {
  std::string sentence;
  for (const MotionAnswer& motion : study.motions) {
    sentence += motion.motion.name + ": " + motion_sentence(motion) + " ";
  }
  sentence.pop_back();
  ordered_json json = hal::json_object({{"tpa", study.project.name},
                                        {"sentence", sentence},
                                        {"chain", chain_sentence(study)},
                                        {"repair", repair_sentence(study)},
                                        {"unit", study.frfs.matrix.response_unit},
                                        {"software", study.software},
                                        {"method", method_json(study.project)},
                                        {"paths", places_json(study.frfs.matrix.excitations)},
                                        {"targets", places_json(study.project.targets)},
                                        {"frfs", frfs_json(study.frfs)},
                                        {"motions", ordered_json::array()},
                                        {"data_sha256", ordered_json::array()}});
  for (const MotionAnswer& motion : study.motions) {
    json["motions"].push_back(motion_json(motion, study));
  }
  for (const auto& [file, hash] : study.hashes) {
    json["data_sha256"].push_back(hal::json_object({{"file", file}, {"sha256", hash}}));
  }
  return json_text(json, 1);
}

}  // namespace rvbench::bench
