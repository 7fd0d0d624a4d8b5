#include "bench/tpa_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/frf/signed_axis.hpp"
#include "bench/report/finding_text.hpp"
#include "bench/report/html.hpp"
#include "hal/formats/printable.hpp"
#include "hal/types/units.hpp"

namespace rvbench::bench {
namespace {

using Eigen::Index;
using Places = std::vector<DegreeOfFreedom>;

std::string axis_name(const DegreeOfFreedom& place) {
  return analysis::axis_of(place.direction).axis;
}

// Whether another path has the same joint and axis.
bool is_ambiguous(const DegreeOfFreedom& path, const Places& paths) {
  return std::ranges::count_if(paths, [&](const DegreeOfFreedom& other) {
           return joint_of(other) == joint_of(path) && axis_name(other) == axis_name(path);
         }) > 1;
}

std::string joint_or_point(const DegreeOfFreedom& path, const Places& paths) {
  return is_ambiguous(path, paths) ? path.point : joint_of(path);
}

std::string part_text(const analysis::Diagnosis& diagnosis) {
  if (diagnosis.findings.empty()) {
    return diagnosis.resolvable ? "shows no fault above its limit" : "cannot be judged";
  }
  const analysis::Finding& first = diagnosis.findings.front();
  return fmt::format("points to its {} ({}), order {:.4g}", report::spoken(first.component),
                     report::spoken(first.mechanism), first.order);
}

// "J3 leads at X and Z (straight slow), at X (five axis slow)": where a joint leads.
std::string where_it_leads(const TpaStudy& study, const std::string& joint) {
  std::string text;
  for (const MotionAnswer& motion : study.motions) {
    std::string targets;
    for (const BandAnswer& answer : motion.answers) {
      if (answer.word != LeadWord::leads) continue;
      const auto& paths = motion.contributions.paths;
      if (joint_of(paths[std::size_t(answer.ranking.paths.front().path)]) != joint) continue;
      const std::string name = target_name(answer.ranking.target, motion.contributions.targets);
      if (targets.find(name) != std::string::npos) continue;
      targets += (targets.empty() ? "" : " and ") + name;
    }
    if (targets.empty()) continue;
    text += (text.empty() ? "at " : ", at ") + targets + " in \"" + motion.motion.name + "\"";
  }
  return text;
}

std::string share_text(double share) {
  return std::isfinite(share) ? fmt::format("{:.0f} %", 100 * share) : "an unknown share";
}

double above_second(const analysis::TargetRanking& ranking) {
  if (ranking.paths.size() < 2 || !(ranking.paths[1].rms > 0)) return not_known;
  return 100 * (ranking.paths[0].rms / ranking.paths[1].rms - 1);
}

void print_answer(Console& console, const BandAnswer& answer, const MotionAnswer& motion,
                  const std::string& unit) {
  const auto& [ranking, certainty, word] = answer;
  const Places& paths = motion.contributions.paths;
  const analysis::BandContribution& first = ranking.paths.front();
  console.out << fmt::format(
      "  {}  {}: {}\n",
      hal::formats::printable(target_name(ranking.target, motion.contributions.targets)),
      band_text(ranking.band), hal::formats::printable(answer_text(answer, paths)));
  if (word == LeadWord::not_validated) return;
  console.out << fmt::format("     {} {:.3g} {} (95 %: {:.3g} to {:.3g}), phase {:.0f}°",
                             hal::formats::printable(path_name(first.path, paths)), first.rms, unit,
                             certainty.rms.front().low, certainty.rms.front().high,
                             first.phase_rad / units::degree_rad);
  if (ranking.paths.size() > 1) {
    const analysis::BandContribution& second = ranking.paths[1];
    console.out << fmt::format("; {:.0f} % above {} {:.3g}, in {:.0f} % of the replicates",
                               above_second(ranking),
                               hal::formats::printable(path_name(second.path, paths)), second.rms,
                               100 * certainty.order_held.front());
  }
  console.out << '\n';
}

void print_motion(Console& console, const MotionAnswer& motion, const std::string& unit) {
  console.out << fmt::format(
      "{}: validation {:.3f} over all lines\n",
      paint(console, Tone::strong, hal::formats::printable(motion.motion.name)),
      motion.contributions.validation.score());
  for (const BandAnswer& answer : motion.answers) print_answer(console, answer, motion, unit);
  for (const std::string& text : findings_text(motion.findings)) {
    console.out << "  " << hal::formats::printable(text) << '\n';
  }
  for (const analysis::TpaFault& fault : motion.findings.faults) {
    console.out << "  ! " << hal::formats::printable(fault.where + ": " + fault.reason) << '\n';
  }
}

void print_frfs(Console& console, const TpaFrfs& frfs) {
  if (frfs.alignment.is_used) console.out << alignment_text(frfs.alignment) << '\n';
  if (frfs.hits > 0) {
    console.out << fmt::format("{} of {} hits used\n", frfs.hits - frfs.rejected.size(), frfs.hits);
  }
  for (const analysis::DirectionDoubt& doubt : frfs.doubts) {
    console.out << "  ! " << hal::formats::printable(doubt_text(doubt)) << '\n';
  }
}

}  // namespace

std::string path_label(Index path, const Places& paths) {
  const DegreeOfFreedom& place = paths[std::size_t(path)];
  return joint_or_point(place, paths) + ":" + axis_name(place);
}

std::string path_name(Index path, const Places& paths) {
  const DegreeOfFreedom& place = paths[std::size_t(path)];
  return joint_or_point(place, paths) + " " + place.direction;
}

std::string target_name(Index target, const Places& targets) {
  const DegreeOfFreedom& place = targets[std::size_t(target)];
  const bool one_point = std::ranges::all_of(
      targets, [&](const DegreeOfFreedom& other) { return other.point == place.point; });
  return one_point ? axis_name(place) : place.point + " " + axis_name(place);
}

std::string band_text(const analysis::TpaBand& band) {
  return fmt::format("{:g} to {:g} Hz", band.first_Hz, band.last_Hz);
}

std::string answer_text(const BandAnswer& answer, const Places& paths) {
  const auto& ranked = answer.ranking.paths;
  const std::string first = path_name(ranked.front().path, paths);
  switch (answer.word) {
    case LeadWord::leads: return first + " leads";
    case LeadWord::not_sure:
      if (ranked.size() < 2) return "cannot tell whether " + first + " leads";
      return "cannot tell whether " + first + " or " +
             path_name(ranked[answer.certainty.rival()].path, paths) + " leads";
    case LeadWord::not_told_apart: return "cannot tell: the references moved together";
    case LeadWord::contradicted:
      return "cannot tell: sensors or FRFs contradict each other; the largest would be " + first;
    case LeadWord::target_unexplained:
      return fmt::format("cannot tell: the paths explain {} of what the target shows",
                         share_text(target_score(answer.ranking)));
    case LeadWord::not_validated: break;
  }
  if (!std::isfinite(answer.ranking.validation_score)) {
    return "cannot tell: nothing is left to validate by";
  }
  return fmt::format("cannot tell: validation {:.2f}, less than {:g}",
                     answer.ranking.validation_score, analysis::TpaFaultLimits{}.least_score);
}

std::string motion_sentence(const MotionAnswer& motion) {
  std::string text;
  for (std::size_t i = 0; i < motion.contributions.targets.size(); ++i) {
    const BandAnswer& answer = motion.answers[i];
    text += (text.empty() ? "" : "; ") +
            target_name(answer.ranking.target, motion.contributions.targets) + ": " +
            answer_text(answer, motion.contributions.paths);
  }
  return text + ".";
}

std::string chain_sentence(const TpaStudy& study) {
  const MotionAnswer* judged = nullptr;
  const MotionAnswer* unjudged = nullptr;
  for (const MotionAnswer& motion : study.motions) {
    if (motion.reducer && judged == nullptr) judged = &motion;
    if (motion.motion.reducer && !motion.reducer && unjudged == nullptr) unjudged = &motion;
  }
  if (judged != nullptr) {
    const ReducerAnswer& answer = *judged->reducer;
    std::string text = fmt::format(
        "From the robot to the joint to the part: {} leads {}; its reducer's recording {}.",
        answer.reducer.joint, where_it_leads(study, answer.reducer.joint),
        part_text(answer.judgement.diagnosis));
    if (answer.after) {
      text +=
          fmt::format(" The recording after the repair {}.", part_text(answer.after->diagnosis));
    }
    return text;
  }
  if (unjudged == nullptr) return "";
  if (!unjudged->reducer_refusal.empty()) {
    return fmt::format(
        "The way ends at the joint: the recording of {}'s reducer cannot be judged: {}.",
        unjudged->motion.reducer->joint, unjudged->reducer_refusal);
  }
  return fmt::format("The way ends at the joint: no path of {}, whose reducer was recorded, leads.",
                     unjudged->motion.reducer->joint);
}

std::string repair_sentence(const TpaStudy& study) {
  std::string text;
  for (const MotionAnswer& motion : study.motions) {
    if (!motion.repair) continue;
    text += (text.empty() ? "After the repair, " : "; ") + motion.motion.name + ": ";
    for (Index target = 0; target < motion.repair->before_rms.rows(); ++target) {
      text += fmt::format("{}{} {}", target == 0 ? "" : ", ",
                          target_name(target, motion.contributions.targets),
                          level_change_text(change_dB(*motion.repair, target, 0)));
    }
  }
  return text.empty() ? "" : text + ".";
}

std::string level_change_text(double change_dB) {
  const double tenths = std::round(10 * change_dB) / 10;
  return fmt::format("{:+.1f} dB", tenths == 0 ? 0.0 : tenths);  // never -0.0
}

std::string alignment_text(const analysis::HammerAlignment& alignment) {
  return fmt::format(
      "blows turned by up to {:.1f}° against the sensors, which reciprocity tells, were set right: "
      "the FRFs' asymmetry fell from {:.2g} to {:.2g} %",
      alignment.largest_turn_rad() / units::degree_rad, 100 * alignment.asymmetry_before,
      100 * alignment.asymmetry_after);
}

std::vector<std::string> findings_text(const MethodFindings& findings) {
  std::vector<std::string> lines;
  if (std::isfinite(findings.disagreement)) {
    lines.push_back(fmt::format(
        "blocked forces: both halves of the indicators differ by {:.2g} % of their power",
        100 * findings.disagreement));
  }
  for (const MountAnswer& mount : findings.mounts) {
    const auto& [path, found, deviation] = mount;
    lines.push_back(fmt::format(
        "mount at {}: {:.4g} ± {:.2g} N/m, {:.4g} ± {:.2g} N s/m, {:.4g} ± {:.2g} kg",
        analysis::name_of(path), found.stiffness_N_m, deviation.stiffness_N_m, found.damping_N_s_m,
        deviation.damping_N_s_m, found.mass_kg, deviation.mass_kg));
  }
  if (!findings.mounts.empty()) {
    lines.push_back(fmt::format("mounts: score {:.3f} at the lines that they were not fitted to",
                                findings.mounts_score));
  }
  return lines;
}

const char* to_string(analysis::TpaFaultKind kind) noexcept {
  using Kind = analysis::TpaFaultKind;
  switch (kind) {
    case Kind::too_few_indicators: return "too_few_indicators";
    case Kind::rank_below_paths: return "rank_below_paths";
    case Kind::incoherent_lines: return "incoherent_lines";
    case Kind::sign_reversed: return "sign_reversed";
    case Kind::directions_swapped: return "directions_swapped";
    case Kind::missing_path: return "missing_path";
    case Kind::not_validated: return "not_validated";
    case Kind::halves_disagree: return "halves_disagree";
    case Kind::no_mount: return "no_mount";
    case Kind::references_together: return "references_together";
    case Kind::frf_errors_unknown: return "frf_errors_unknown";
  }
  return "unknown";
}

std::string doubt_text(const analysis::DirectionDoubt& doubt) { return "FRFs: " + doubt.reason; }

void print_study(Console& console, const TpaStudy& study) {
  print_frfs(console, study.frfs);
  for (const MotionAnswer& motion : study.motions) {
    console.out << '\n';
    print_motion(console, motion, study.frfs.matrix.response_unit);
  }
  console.out << '\n';
  for (const MotionAnswer& motion : study.motions) {
    console.out << hal::formats::printable(motion.motion.name + ": " + motion_sentence(motion))
                << '\n';
  }
  for (const std::string& sentence : {chain_sentence(study), repair_sentence(study)}) {
    if (!sentence.empty()) console.out << hal::formats::printable(sentence) << '\n';
  }
}

}  // namespace rvbench::bench
