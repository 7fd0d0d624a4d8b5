#include "bench/explanation_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rvbench::bench {
namespace {

constexpr std::size_t most_places = 5;
constexpr std::size_t most_sources = 2;
constexpr std::size_t most_records = 12;

std::string estimate_text(const analysis::Estimate& e) {
  return fmt::format("{} {:.4g} {} (90 %: {:.4g} to {:.4g})", e.name, e.value, e.unit, e.low,
                     e.high);
}

std::string predicted_text(const PredictedMean& mean, const std::string& unit) {
  return fmt::format("      mean {:.6g}, predicted {:.6g} ± {:.2g} {} (90 %){}\n", mean.measured,
                     mean.predicted, mean.half_width, unit,
                     mean.is_inside()
                         ? ""
                         : ": outside, so the law ends before, or an input is not what it is said "
                           "to be (see the notes)");
}

void print_answer(Console& console, const analysis::Explanation& e) {
  const bool quiet = e.verdict == analysis::ExplainVerdict::null;
  console.out << paint(console, quiet ? Tone::good : Tone::strong, to_string(e.verdict)) << "  "
              << e.reason << '\n';
  for (const analysis::ExplainedEffect& effect : e.effects) {
    console.out << fmt::format("\n  {}: {} ({})\n", to_string(effect.verdict), effect.name,
                               effect.where);
    for (const analysis::Estimate& p : effect.parameters) {
      console.out << "    " << estimate_text(p) << '\n';
    }
    console.out << fmt::format(
        "    held-out error {} -> {}; log density {:+.1f} ± {:.1f}; best in {:.0f} % of "
        "bootstraps\n",
        analysis::error_text(effect.error_before, e.in_standard_errors),
        analysis::error_text(effect.error_after, e.in_standard_errors), effect.over_before.delta,
        effect.over_before.se, 100 * effect.share_won);
    for (const analysis::RivalEffect& rival : effect.rivals) {
      console.out << fmt::format("    rival {} ({}): {} by {:.1f} ± {:.1f}\n", rival.name,
                                 rival.where, rival.behind.delta < 0 ? "better" : "worse",
                                 std::abs(rival.behind.delta), rival.behind.se);
    }
    if (!effect.next_experiment.empty()) {
      console.out << "    would decide: " << effect.next_experiment << '\n';
    }
  }
  if (e.ceiling_after.known) {
    console.out << fmt::format("\n  a law of any shape would reach {} held out\n",
                               analysis::error_text(e.ceiling_after.error, e.in_standard_errors));
  }
  for (const analysis::Estimate& p : e.nuisances) {
    console.out << "  nuisance " << estimate_text(p) << '\n';
  }
}

std::string cluster_text(const analysis::ResidualCluster& c) {
  return fmt::format("{}: {:+.3g} {} ({:.0f} standard errors), {} condition{}", place_text(c),
                     c.apart, c.unit, std::abs(c.standard_errors), c.conditions.size(),
                     c.conditions.size() == 1 ? "" : "s");
}

void print_located(Console& console, const Located& located) {
  if (located.cells == 0) return;
  console.out << fmt::format(
      "\n  where it differs by more than chance, of {} means and lines: {} places -> {}\n",
      located.cells, located.before.size(), located.after.size());
  const std::size_t shown = std::min(located.before.size(), most_places);
  for (std::size_t i = 0; i < shown; ++i) {
    console.out << "    " << cluster_text(located.before[i]) << '\n';
  }
  if (shown < located.before.size()) {
    console.out << fmt::format("    and {} more: see explain.json\n",
                               located.before.size() - shown);
  }
  for (const Twin::Noise& noise : located.noise) {
    console.out << "    noise of " << noise_text(noise) << '\n';
  }
  for (const std::string& line : told(located.missing_before, most_sources)) {
    console.out << "    " << line << '\n';
  }
  for (const std::string& line : told(located.missing_after, most_sources)) {
    console.out << "    left over: " << line << '\n';
  }
}

// Those that were only predicted, then the worst.
void print_records(Console& console, std::vector<RecordError> records) {
  if (records.empty()) return;
  console.out << "\n  error by record, as the plant was -> with what was left out\n";
  const std::size_t all = records.size();
  if (all > most_records) {
    std::ranges::stable_sort(records, {}, [](const RecordError& r) {
      return std::pair(r.learned_from, std::isfinite(r.relative_after) ? -r.relative_after : 0.0);
    });
    records.resize(most_records);
  }
  for (const RecordError& r : records) {
    console.out << fmt::format("    {:31} {:9} {:.4g} -> {:.4g} {} ({:.3g} -> {:.3g} %){}\n",
                               r.record, r.channel, r.before, r.after, r.unit,
                               100 * r.relative_before, 100 * r.relative_after,
                               r.learned_from ? "" : ", only predicted");
    if (r.mean) console.out << predicted_text(*r.mean, r.unit);
  }
  if (all > most_records) {
    console.out << fmt::format("    and {} more: see explain.json\n", all - most_records);
  }
}

void print_self_null(Console& console, const analysis::SelfNull& self_null,
                     bool in_standard_errors) {
  if (!self_null.known) return;
  console.out << fmt::format("\n  one repeat as the model of another: {} ({} apart)\n",
                             self_null.found.empty() ? "NULL" : "something changed",
                             analysis::error_text(self_null.error, in_standard_errors));
  for (const analysis::Estimate& p : self_null.found) {
    console.out << "    " << estimate_text(p) << '\n';
  }
}

}  // namespace

void print_explanation(Console& console, const analysis::Explanation& explanation,
                       const ExplainFacts& facts) {
  print_answer(console, explanation);
  print_located(console, facts.located);
  print_records(console, facts.records);
  print_self_null(console, explanation.self_null, explanation.in_standard_errors);
}

}  // namespace rvbench::bench
