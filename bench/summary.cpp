#include "bench/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "analysis/spectral_lines.hpp"
#include "bench/findings_stand.hpp"
#include "bench/limit_checks.hpp"
#include "bench/report/finding_text.hpp"
#include "bench/report/html.hpp"
#include "bench/twin_check.hpp"

namespace rvbench::bench {
namespace {

constexpr std::size_t most_lines = 8;

std::string evidence_of(const analysis::Finding& finding, double period_turns) {
  std::string text;
  for (std::size_t i = 0; i < finding.line_orders.size(); ++i) {
    text += fmt::format("{}{} {:.3f}", text.empty() ? "" : ", ",
                        report::order_text(finding.line_orders[i], period_turns),
                        finding.line_depths[i]);
  }
  return text;
}

// @param counts  whether it says that the part is bad
void print_finding(Console& console, const analysis::Finding& finding, double period_turns,
                   bool counts) {
  console.out << fmt::format(
      "  {}: {}, {}{}\n", finding.component, finding.mechanism, report::limit_text(finding),
      finding.table4_item.empty() ? "" : " (Table 4: " + finding.table4_item + ")");
  console.out << fmt::format(
      "    depth {}, limit {:.3f}; order {}, {}; p {}", report::severity_text(finding),
      finding.limit, report::order_text(finding.order, period_turns),
      report::frequency_text(finding.frequency_Hz, finding.order), report::p_text(finding.p_value));
  if (counts) {
    console.out << fmt::format("; confidence {:.0f} %", 100 * finding.confidence);
  }
  console.out << '\n';
  console.out << "    seen in " << finding.points.size()
              << (finding.points.size() == 1 ? " point" : " points")
              << "; envelope lines (order depth): " << evidence_of(finding, period_turns) << '\n';
  const std::string sound = report::sound_text(finding);
  if (!sound.empty()) console.out << "    " << sound << '\n';
  const std::string growth = report::growth_text(finding);
  if (!growth.empty()) console.out << "    " << growth << '\n';
  const std::string rivals = report::rivals_text(finding);
  if (!rivals.empty()) console.out << "    " << rivals << '\n';
  const std::string cause = report::cause_text(finding);
  if (!cause.empty()) console.out << "    " << cause << '\n';
  if (counts) console.out << "    advice: " << report::advice_text(finding) << '\n';
}

// "  171.56 Hz at 1815 rpm  order   5.6714"
std::string place_of(const analysis::SpectralLine& line) {
  return fmt::format("{:>23}  order {:8.4f}", report::frequency_text(line.frequency_Hz, line.order),
                     line.order);
}

struct ExplainedLine {
  analysis::SpectralLine strongest;
  std::size_t channels = 0;
};

// Lines of the signals' own spectra that the kinematics names, by order.
std::vector<ExplainedLine> explained_lines(const Judgement& judgement) {
  std::map<std::string, ExplainedLine> seen;
  for (const JudgedPoint& point : judgement.points) {
    for (const analysis::ChannelExamination& channel : point.examination.channels) {
      std::map<std::string, analysis::SpectralLine> named;
      for (const auto& line : channel.lines) {
        if (!line.meaning.empty()) named.emplace(line.meaning, line);  // the strongest comes first
      }
      for (const auto& [meaning, line] : named) {
        ExplainedLine& explained = seen[meaning];
        if (line.amplitude > explained.strongest.amplitude) explained.strongest = line;
        ++explained.channels;
      }
    }
  }
  std::vector<ExplainedLine> lines;
  for (const auto& [meaning, line] : seen) lines.push_back(line);
  std::sort(lines.begin(), lines.end(), [](const ExplainedLine& a, const ExplainedLine& b) {
    return a.strongest.order < b.strongest.order;
  });
  return lines;
}

// The characteristic orders, and the strongest of their harmonics and sidebands.
void print_explained(Console& console, const Judgement& judgement,
                     const analysis::Kinematics& kinematics) {
  const std::vector<ExplainedLine> lines = explained_lines(judgement);
  if (lines.empty()) return;
  std::vector<double> amplitudes;
  for (const ExplainedLine& line : lines) amplitudes.push_back(line.strongest.amplitude);
  std::sort(amplitudes.rbegin(), amplitudes.rend());
  const double least = amplitudes[std::min(most_lines, amplitudes.size()) - 1];
  std::size_t channels = 0;
  for (const JudgedPoint& point : judgement.points) channels += point.examination.channels.size();

  console.out << "\nLines that the kinematics explains:\n";
  std::size_t left_out = 0;
  for (const ExplainedLine& line : lines) {
    if (!analysis::is_characteristic(line.strongest, kinematics) &&
        line.strongest.amplitude < least) {
      ++left_out;
      continue;
    }
    console.out << fmt::format("  {}  {} ({} of {} channels)\n", place_of(line.strongest),
                               line.strongest.meaning, line.channels, channels);
  }
  if (left_out > 0) console.out << "  and " << left_out << " weaker ones\n";
}

void print_unexplained(Console& console, const std::vector<analysis::SpectralLine>& lines) {
  if (lines.empty()) return;
  console.out << "\nLines that the kinematics does not explain:\n";
  for (std::size_t i = 0; i < std::min(lines.size(), most_lines); ++i) {
    console.out << fmt::format("  {}  amplitude {:.3g}{}\n", place_of(lines[i]), lines[i].amplitude,
                               lines[i].meaning.empty() ? "" : "; seen as " + lines[i].meaning);
  }
  if (lines.size() > most_lines) console.out << "  and " << lines.size() - most_lines << " more\n";
}

void print_quality(Console& console, const std::vector<analysis::QualityNote>& notes) {
  if (notes.empty()) return;
  console.out << "\nQuality of the data:\n";
  for (std::size_t i = 0; i < std::min(notes.size(), most_lines); ++i) {
    const char* state = notes[i].invalidates  ? " (invalid)"
                        : notes[i].leaves_out ? " (left out)"
                                              : "";
    console.out << fmt::format("  {}: {}{}\n", notes[i].where, notes[i].what, state);
  }
  if (notes.size() > most_lines) console.out << "  and " << notes.size() - most_lines << " more\n";
}

// Whether something is there to be held against them.
bool has_measured(const Judgement& judgement) {
  return std::ranges::any_of(judgement.points,
                             [](const auto& point) { return point.status != not_recorded; }) ||
         std::ranges::any_of(judgement.limits,
                             [](const auto& check) { return std::isfinite(check.measured); });
}

void print_limits(Console& console, const Judgement& judgement) {
  if (judgement.limits.empty() || !has_measured(judgement)) return;
  console.out << "\nLimits:\n";
  for (const LimitCheck& check : judgement.limits) {
    const std::string bound = bound_text(check);
    const std::string name = name_of(check);
    if (!is_measured(check)) {
      console.out << fmt::format("  no value {} ({}): {}{}\n", name, bound, why_unmeasured(check),
                                 first_lacking(check));
    }
    if (std::isnan(check.measured)) continue;
    const char* state = !is_beyond(check)          ? "within"
                        : std::isfinite(check.min) ? "BELOW "
                                                   : "ABOVE ";
    const std::string coverage = coverage_of(check);
    console.out << fmt::format("  {} {}: {} ({}) at {}{}\n", state, name,
                               with_unit(check.measured, check.unit), bound, check.where,
                               coverage.empty() ? "" : "; " + coverage);
  }
}

void print_findings(Console& console, const Judgement& judgement, double period_turns) {
  const analysis::Diagnosis& diagnosis = judgement.diagnosis;
  const bool stand = findings_stand(judgement);
  if (!stand && !(diagnosis.below_limit.empty() && diagnosis.findings.empty())) {
    console.out << "\nNot to be read as findings, for they were "
                << report::seen_but(judgement.ending) << '\n';
  }
  if (!diagnosis.below_limit.empty()) console.out << "\nSignificant, but within limits:\n";
  for (const auto& finding : diagnosis.below_limit) {
    print_finding(console, finding, period_turns, false);
  }
  if (!diagnosis.findings.empty()) console.out << "\nAbove their limit:\n";
  for (const auto& finding : diagnosis.findings) {
    print_finding(console, finding, period_turns, stand);
  }
  const analysis::Finding* second = diagnosis.second();
  if (!stand || second == nullptr) return;
  console.out << fmt::format("\nSecond hypothesis: {}: {}, depth {}, limit {:.3f}, p {}\n",
                             second->component, second->mechanism, report::severity_text(*second),
                             second->limit, report::p_text(second->p_value));
}

// What the teardown of a bench at fault came to; nothing if it has nothing to say.
void print_teardown(Console& console, const RunFacts& facts) {
  for (const auto& [time_s, event] : facts.events) {
    if (event.starts_with("in teardown: ")) console.out << "\nIn" << event.substr(2) << '\n';
  }
}

// What was said last: a run that is judged again says it once more.
void print_twin(Console& console, const RunFacts& facts) {
  std::string last;
  for (const auto& [time_s, event] : facts.events) {
    if (event.starts_with(differs_from_twin)) last = event;
  }
  if (!last.empty()) console.out << "\nThe run " << last << '\n';
}

void print_verdict(Console& console, const Judgement& judgement) {
  const Outcome outcome = judgement.ending.outcome;
  console.out << paint(console, tone_of(outcome), to_string(outcome)) << "  "
              << judgement.ending.reason << '\n';
}

void print_place_of_report(Console& console, const std::filesystem::path& folder) {
  const std::filesystem::path report = folder / "report.html";
  if (!folder.empty() && std::filesystem::exists(report)) {
    console.out << "Report: " << report.string() << '\n';
  }
}

struct ShareOfLimit {
  double share = 0;  // measured over limit; infinite above a limit of 0
  std::string text;
};

ShareOfLimit share_of(const analysis::Finding& finding) {
  return {finding.limit > 0 ? finding.severity / finding.limit : HUGE_VAL,
          fmt::format("{}: {}, depth {} (max {:.3f})", finding.component, finding.mechanism,
                      report::severity_text(finding), finding.limit)};
}

// Findings above their limit in the order of the diagnosis, then the rest, nearest first.
std::vector<ShareOfLimit> shares_of_limits(const Judgement& judgement) {
  std::vector<ShareOfLimit> shares;
  for (const auto& finding : judgement.diagnosis.findings) shares.push_back(share_of(finding));
  const auto found = static_cast<std::ptrdiff_t>(shares.size());
  for (const auto& finding : judgement.diagnosis.below_limit) {
    if (std::isfinite(finding.severity)) shares.push_back(share_of(finding));
  }
  for (const LimitCheck& check : judgement.limits) {
    if (std::isnan(check.measured)) continue;
    shares.push_back({share_of_bound(check),
                      fmt::format("{}: {} ({})", name_of(check),
                                  with_unit(check.measured, check.unit), bound_text(check))});
  }
  std::ranges::sort(shares.begin() + found, shares.end(), std::greater{}, &ShareOfLimit::share);
  return shares;
}

}  // namespace

void print_brief(Console& console, const Judgement& judgement,
                 const std::filesystem::path& folder) {
  constexpr std::size_t most_limits = 3;
  print_verdict(console, judgement);
  const std::vector<ShareOfLimit> shares = shares_of_limits(judgement);
  if (!shares.empty() && findings_stand(judgement)) {
    console.out << "Nearest limits, and what was measured of each:\n";
    for (std::size_t i = 0; i < std::min(most_limits, shares.size()); ++i) {
      const double percent = 100 * shares[i].share;
      console.out << (std::isfinite(percent) ? fmt::format("  {:4.0f} %  ", percent) : "     -    ")
                  << shares[i].text << '\n';
    }
  }
  print_place_of_report(console, folder);
}

void print_summary(Console& console, const Judgement& judgement,
                   const analysis::Kinematics& kinematics, const std::filesystem::path& folder) {
  const analysis::Diagnosis& diagnosis = judgement.diagnosis;
  print_quality(console, diagnosis.quality);
  print_unexplained(console, diagnosis.unexplained);
  print_explained(console, judgement, kinematics);
  print_limits(console, judgement);
  print_findings(console, judgement, kinematics.period_turns);
  print_teardown(console, judgement.facts);
  print_twin(console, judgement.facts);
  console.out << '\n';
  print_verdict(console, judgement);
  print_place_of_report(console, folder);
}

void print_unwritten(Console& console, const Judgement& judgement) {
  for (const std::string& file : judgement.unwritten) {
    console.err << "rvbench: not written: " << file << '\n';
  }
}

}  // namespace rvbench::bench
