#include "bench/report/tpa_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/report/tpa_sections.hpp"
#include "bench/tpa_text.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench {
namespace {

using report::paragraph;
using report::section;
using report::table;

// The joint that leads at most targets, and how many answers name one.
std::string word_of(const TpaStudy& study) {
  std::map<std::string, int> leads;
  for (const MotionAnswer& motion : study.motions) {
    for (const BandAnswer& answer : motion.answers) {
      if (answer.word != LeadWord::leads) continue;
      const auto& paths = motion.contributions.paths;
      ++leads[joint_of(paths[std::size_t(answer.ranking.paths.front().path)])];
    }
  }
  const auto most = std::ranges::max_element(leads, {}, [](const auto& one) { return one.second; });
  return most == leads.end() ? "CANNOT TELL" : most->first;
}

std::string sentence_section(const TpaStudy& study) {
  std::string sentences;
  for (const MotionAnswer& motion : study.motions) {
    sentences +=
        fmt::format("<p><b>{}</b>: {} Validation {:.3f}.</p>\n", xml_escaped(motion.motion.name),
                    xml_escaped(motion_sentence(motion)), motion.contributions.validation.score());
  }
  for (const std::string& sentence : {chain_sentence(study), repair_sentence(study)}) {
    if (!sentence.empty()) sentences += paragraph(sentence);
  }
  return fmt::format(
      "<h1>Who shakes what: {}</h1>\n<div class=\"verdict\"><div class=\"word\">{}</div>{}</div>\n",
      xml_escaped(study.project.name), xml_escaped(word_of(study)), sentences);
}

std::string faults_of(const MotionAnswer& motion) {
  std::string items;
  for (const analysis::TpaFault& fault : motion.findings.faults) {
    items +=
        "<li><b>" + xml_escaped(fault.where) + "</b>: " + xml_escaped(fault.reason) + "</li>\n";
  }
  return items.empty() ? "" : "<ul class=\"left-out\">\n" + items + "</ul>\n";
}

std::string motion_section(const MotionAnswer& motion, const TpaStudy& study) {
  const std::string& unit = study.frfs.matrix.response_unit;
  std::string found;
  for (const std::string& text : findings_text(motion.findings)) found += paragraph(text);
  return section(motion.motion.name,
                 faults_of(motion) + found + report::contributions_part(motion, unit) +
                     report::frequency_maps(motion, unit) + report::time_maps(motion, unit) +
                     report::validation_part(motion, unit) +
                     report::forces_part(motion, study.frfs));
}

// The findings of the first motion that has any: one recording may stand for several motions.
std::string reducer_sections(const TpaStudy& study) {
  const auto judged = std::ranges::find_if(
      study.motions, [](const MotionAnswer& motion) { return motion.reducer.has_value(); });
  if (judged == study.motions.end()) return "";
  const ReducerAnswer& answer = *judged->reducer;
  ReportInput input;
  input.judgement = answer.judgement;
  input.kinematics = answer.kinematics;
  return section("From the joint to the part",
                 paragraph(chain_sentence(study)) +
                     paragraph("Recording of " + answer.reducer.joint + ": " +
                               answer.reducer.recording + ". " + answer.judgement.ending.reason)) +
         report::findings_section(input);
}

std::string repair_section(const TpaStudy& study) {
  std::string body;
  for (const MotionAnswer& motion : study.motions) body += report::repair_part(motion, study);
  return section("Before and after the repair", body);
}

std::string hits_text(const TpaFrfs& frfs) {
  std::string body;
  for (const analysis::DirectionDoubt& doubt : frfs.doubts) body += paragraph(doubt_text(doubt));
  if (frfs.alignment.is_used) body += paragraph(alignment_text(frfs.alignment));
  if (frfs.hits == 0) return body;
  std::vector<std::vector<std::string>> rows;
  for (const RejectedHit& hit : frfs.rejected) {
    rows.push_back({xml_escaped(hit.source), xml_escaped(hit.reason)});
  }
  body += paragraph(fmt::format("{} of {} hits were averaged over.",
                                frfs.hits - frfs.rejected.size(), frfs.hits));
  if (!rows.empty()) {
    body += "<details><summary>Hits that were not</summary>" + table({"hit", "why"}, rows) +
            "</details>\n";
  }
  return body;
}

std::string method_section(const TpaStudy& study) {
  const analysis::LineGrid grid = grid_of(study.frfs.matrix);
  std::string body = paragraph(std::string(tpa_method(study.project.method).how));
  body += paragraph(fmt::format(
      "{} lines, {:g} Hz apart; {} indicators; rule {}; {} lines were left out for want of "
      "coherence. A contribution is complex, and its bar the RMS over the band. Intervals hold in "
      "95 % of {} replicates, in which blocks and hits are drawn anew, ready FRFs within their "
      "errors. A path leads if it is ahead of all others in 95 % of them and if the paths explain "
      "{:.0f} % of what was not fitted to.",
      grid.lines, grid.step_Hz, study.project.indicators.size(), study.project.rule,
      study.frfs.coherent.left_out, study.project.resampling.replicates,
      100 * analysis::TpaFaultLimits{}.least_score));
  body += hits_text(study.frfs);
  std::vector<std::vector<std::string>> rows;
  for (const auto& [file, hash] : study.hashes) {
    rows.push_back({"<span class=\"hash\">" + xml_escaped(file) + "</span>",
                    "<span class=\"hash\">" + hash + "</span>"});
  }
  body += "<details><summary>Data</summary>" + table({"file", "SHA-256"}, rows) + "</details>\n";
  return section("Method and data", body + paragraph("rvbench " + study.software));
}

}  // namespace

std::string make_tpa_page(const TpaStudy& study) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      xml_escaped(word_of(study) + ": " + study.project.name) + "</title>\n<style>\n" +
      report::style_sheet() + "</style></head><body><main>\n" + sentence_section(study);
  for (const MotionAnswer& motion : study.motions) html += motion_section(motion, study);
  return html + reducer_sections(study) + repair_section(study) + method_section(study) +
         "</main></body></html>\n";
}

}  // namespace rvbench::bench
