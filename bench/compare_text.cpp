#include "bench/compare_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/compare/compared_channels.hpp"
#include "bench/report/finding_text.hpp"
#include "bench/report/html.hpp"
#include "hal/formats/printable.hpp"

namespace rvbench::bench {
namespace {

using analysis::Change;
using analysis::Comparison;
using analysis::Headline;

constexpr std::size_t most_named = 4;
constexpr std::size_t most_rows = 12;
constexpr std::size_t most_families = 3;
constexpr double worth_naming = 0.25;  // of the cells of a part

std::string counted(std::size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string named(const Headline& h, const Comparison& comparison) {
  const std::string text =
      comparison.quantities[h.quantity].name + " by " + change_text(h.median_dB);
  const std::size_t points = comparison.points.size();
  return points == 1 ? text : fmt::format("{} at {} of {} points", text, h.points, points);
}

bool share_lines(std::size_t one, std::size_t other, const Comparison& comparison) {
  return std::ranges::any_of(comparison.quantities, [&](const analysis::Quantity& q) {
    return q.is_in(one) && q.is_in(other);
  });
}

// Whose lines they are, if enough of a part's have changed; and of one that shares none with it.
std::string family_sentence(const Comparison& comparison, const analysis::Kinematics& kinematics) {
  std::vector<analysis::FamilyHeadline> families = analysis::family_headlines(comparison);
  std::erase_if(families, [](const auto& f) { return f.share() < worth_naming; });
  if (families.empty()) return "";
  const std::size_t first = families.front().family;
  const auto next = std::ranges::find_if(families, [&](const auto& f) {
    return f.family != first && !share_lines(first, f.family, comparison);
  });
  return "Most changed: " + family_text(families.front(), kinematics) +
         (next == families.end() ? "" : "; then " + family_text(*next, kinematics)) + ". ";
}

// "3 lines and 2 levels"
std::string kinds_text(const std::vector<Headline>& all, const Comparison& comparison) {
  const auto lines = static_cast<std::size_t>(std::ranges::count_if(
      all, [&](const Headline& h) { return comparison.quantities[h.quantity].is_line(); }));
  std::string text = lines > 0 ? counted(lines, "line") : "";
  if (lines < all.size()) {
    text += (lines > 0 ? " and " : "") + counted(all.size() - lines, "level");
  }
  return text;
}

std::string changed_sentence(const Comparison& comparison) {
  const std::vector<Headline> all = analysis::headlines(comparison);
  std::string names;
  for (std::size_t i = 0; i < std::min(all.size(), most_named); ++i) {
    names += (i == 0 ? "" : "; ") + named(all[i], comparison);
  }
  const std::string more =
      all.size() > most_named ? fmt::format("; and {} more", all.size() - most_named) : "";
  return fmt::format("From A to B {} changed: {}{}.", kinds_text(all, comparison), names, more);
}

// Of values that are seen: no scatter is known of them, or one that hides what matters.
std::string why_it_cannot_be_told(const Comparison& comparison) {
  bool unknown = false, large = false;
  for (const Change& change : comparison.changes) {
    if (!change.seen || change.word != analysis::ChangeWord::cannot_tell) continue;
    (change.freedom > 0 ? large : unknown) = true;
  }
  const std::string hides =
      fmt::format("their scatter would hide {:g} dB", comparison.options.blind_dB);
  if (!unknown) return hides;
  return large ? "no scatter is known of them, or " + hides : "no scatter is known of them";
}

bool is_one_recording(const Comparison& comparison) {
  return comparison.records_b > 0 && comparison.same_in_both.size() == comparison.records_b &&
         comparison.records_a == comparison.records_b;
}

bool has_lines(const Comparison& comparison, std::size_t point) {
  return std::ranges::any_of(comparison.changes, [&](const Change& change) {
    return change.point == point && comparison.quantities[change.quantity].is_line();
  });
}

// Points of which only levels are compared.
std::size_t points_without_lines(const Comparison& comparison) {
  std::size_t without = 0;
  for (std::size_t p = 0; p < comparison.points.size(); ++p) {
    without += has_lines(comparison, p) ? 0 : 1;
  }
  return without;
}

std::string lines_sentence(const Comparison& comparison) {
  const std::size_t without = points_without_lines(comparison);
  if (without == 0) return "";
  std::string text = "Lines were not compared";
  if (without < comparison.points.size()) {
    text += fmt::format(" at {} of {} points", without, comparison.points.size());
  }
  if (comparison.too_short.empty()) return text + ", only levels. ";
  const analysis::ShortRecord& longest = *std::ranges::max_element(
      comparison.too_short, {}, [](const auto& record) { return record.needed_s; });
  return text + fmt::format(
                    ", only levels: to part them a record must last {:.3g} s at {:.0f} rpm, "
                    "and one lasts {:.3g} s. ",
                    longest.needed_s, longest.speed_rpm, longest.length_s);
}

std::string same_sentence(const Comparison& comparison) {
  const std::size_t same = comparison.same_in_both.size();
  if (same == 0 || is_one_recording(comparison)) return "";
  return fmt::format("{} of the {} of B {} in A as well, where nothing can have changed. ", same,
                     counted(comparison.records_b, "record"), same == 1 ? "is" : "are");
}

std::string unchanged_sentence(const Comparison& comparison) {
  const analysis::ChangeCounts counts = analysis::counts_of(comparison);
  std::string text;
  if (counts.not_changed > 0) {
    text = fmt::format(
        "{} of {} did not change: in half of them a change above {:.1f} dB would have been "
        "seen. ",
        counts.not_changed,
        counted(counts.changed + counts.not_changed + counts.cannot_tell, "value"),
        counts.median_detectable_dB);
  }
  if (counts.cannot_tell > 0) {
    text += fmt::format("Of {} it cannot be told: {}. ", counts.cannot_tell,
                        why_it_cannot_be_told(comparison));
  }
  if (counts.noise_changed > 0) {
    text += fmt::format("The noise changed at {} where no line is seen. ",
                        counted(counts.noise_changed, "place"));
  }
  return text;
}

// What the scatter is worth.
std::string scatter_sentence(const Comparison& comparison) {
  const auto has = [&](analysis::ScatterSource source) {
    return std::ranges::any_of(comparison.changes,
                               [&](const Change& c) { return c.source == source && !c.taken; });
  };
  std::string text;
  if (has(analysis::ScatterSource::parts)) {
    text =
        "Where A and B have one record each, the scatter is that of its parts: what differs from "
        "start to start is not in it. ";
  }
  if (has(analysis::ScatterSource::none)) {
    text +=
        "Where one record is too short for parts, or repeats agree to the last digit, no scatter "
        "is known. ";
  }
  return text;
}

// "planet gear (tooth damage)"
std::string signature_text(const analysis::Signature& signature) {
  std::string text = signature.component + " (" + signature.mechanism + ")";
  std::ranges::replace(text, '_', ' ');
  return text;
}

std::string order_of(const analysis::Quantity& quantity, double period_turns) {
  return quantity.is_line() ? "order " + report::order_text(quantity.order, period_turns) : "level";
}

void print_headline(Console& console, const Headline& h, const Comparison& comparison,
                    double period_turns) {
  const analysis::Quantity& quantity = comparison.quantities[h.quantity];
  const Change& most = comparison.changes[h.strongest];
  console.out << fmt::format("  {:>9}  {} ({}{})\n", change_text(h.median_dB), quantity.name,
                             order_of(quantity, period_turns),
                             quantity.component.empty() ? "" : ", " + quantity.component);
  if (h.compared > 1) {
    console.out << fmt::format("             {} to {}, in {} of {} cells, at {} of {}\n",
                               change_text(h.least_dB), change_text(h.most_dB), h.changed,
                               h.compared, h.points, counted(comparison.points.size(), "point"));
  }
  console.out << fmt::format("             {}{}: {}, {:+.1f} ± {:.2g} dB, {}\n",
                             h.compared > 1 ? "most at " : "", place_text(most, comparison),
                             levels_text(most, comparison), most.change_dB, most.uncertainty_dB,
                             "p " + report::p_text(most.adjusted_p));
}

// Whose lines they are; parts share lines, so several.
void print_families(Console& console, const Comparison& comparison,
                    const analysis::Kinematics& kinematics) {
  const auto families = analysis::family_headlines(comparison);
  if (!families.empty()) console.out << "Whose lines changed, most first:\n";
  for (std::size_t i = 0; i < std::min(families.size(), most_families); ++i) {
    console.out << "  " << family_text(families[i], kinematics) << '\n';
  }
  if (!families.empty()) console.out << '\n';
}

void print_points(Console& console, const std::vector<analysis::PointRecords>& points,
                  const std::string& side) {
  for (const analysis::PointRecords& point : points) {
    console.out << fmt::format("  {}: only in {} ({})\n",
                               analysis::point_text(point.speed_rpm, point.load_pct), side,
                               counted(point.records.size(), "record"));
  }
}

void print_left_out(Console& console, const Comparison& comparison) {
  if (comparison.only_a.empty() && comparison.only_b.empty() && comparison.left_out.empty()) return;
  console.out << "\nNot compared, or with a reservation:\n";
  print_points(console, comparison.only_a, "A");
  print_points(console, comparison.only_b, "B");
  for (std::size_t i = 0; i < std::min(comparison.left_out.size(), most_rows); ++i) {
    const analysis::NotCompared& out = comparison.left_out[i];
    console.out << "  " << hal::formats::printable(out.where + ": " + out.why) << '\n';
  }
  if (comparison.left_out.size() > most_rows) {
    console.out << "  and " << comparison.left_out.size() - most_rows << " more: see --json\n";
  }
}

}  // namespace

std::string spoken_word(analysis::ChangeWord word) {
  switch (word) {
    case analysis::ChangeWord::changed: return "CHANGED";
    case analysis::ChangeWord::not_changed: return "NOT CHANGED";
    case analysis::ChangeWord::cannot_tell: return "CANNOT TELL";
  }
  return "";
}

std::string family_text(const analysis::FamilyHeadline& family,
                        const analysis::Kinematics& kinematics) {
  std::string text = signature_text(kinematics.signatures.at(family.family));
  for (const std::size_t other : family.or_of) {
    text += " or " + signature_text(kinematics.signatures.at(other));
  }
  const bool one_way = family.least_dB > 0 || family.most_dB < 0;
  return text + fmt::format(": {:.0f} % of its cells, by {}", 100 * family.share(),
                            one_way ? change_text(family.median_dB)
                                    : fmt::format("{:+.1f} to {}", family.least_dB,
                                                  change_text(family.most_dB)));
}

std::string compare_sentence(const Comparison& comparison, const analysis::Kinematics& kinematics) {
  if (is_one_recording(comparison)) {
    return "A and B are the same recording: nothing can have changed.";
  }
  if (analysis::counts_of(comparison).changed == 0) {
    const std::size_t points = comparison.points.size();
    const bool levels_only = points > 0 && points_without_lines(comparison) == points;
    return fmt::format("From A to B {} is known to have changed by more than {:g} dB.",
                       levels_only ? "no level" : "nothing", comparison.options.least_dB);
  }
  return family_sentence(comparison, kinematics) + changed_sentence(comparison);
}

std::string compare_reservation(const Comparison& comparison) {
  std::string text = same_sentence(comparison) + lines_sentence(comparison) +
                     unchanged_sentence(comparison) + scatter_sentence(comparison);
  if (text.empty()) return "All that was compared changed.";
  text.pop_back();
  return text;
}

double ratio_from_dB(double dB) { return std::pow(10, dB / 20); }

std::string change_text(double change_dB) {
  return std::isfinite(change_dB) ? fmt::format("{:+.1f} dB", change_dB) : "–";
}

std::string levels_text(const Change& change, const Comparison& comparison) {
  const bool has_unit = comparison.quantities[change.quantity].is_line() ||
                        change.quantity == std::size_t(analysis::LevelIndex::rms) ||
                        change.quantity == std::size_t(analysis::LevelIndex::peak);
  const std::string& unit = comparison.channels[change.channel].unit;
  return fmt::format("{:.3g} → {:.3g}{}", ratio_from_dB(change.a_dB), ratio_from_dB(change.b_dB),
                     has_unit && !unit.empty() ? " " + unit : "");
}

std::string place_text(const Change& change, const Comparison& comparison) {
  const analysis::PointRecords& point = comparison.points[change.point].a;
  return analysis::point_text(point.speed_rpm, point.load_pct) + ", " +
         comparison.channels[change.channel].name;
}

void print_comparison(Console& console, const Comparison& comparison,
                      const analysis::Kinematics& kinematics) {
  print_families(console, comparison, kinematics);
  const std::vector<Headline> all = analysis::headlines(comparison);
  if (!all.empty()) console.out << "What changed, B against A:\n";
  for (std::size_t i = 0; i < std::min(all.size(), most_rows); ++i) {
    print_headline(console, all[i], comparison, kinematics.period_turns);
  }
  if (all.size() > most_rows) {
    console.out << "  and " << all.size() - most_rows << " more: see --json or --out\n";
  }
  print_left_out(console, comparison);
  const analysis::ChangeWord word = analysis::word_of(analysis::counts_of(comparison));
  const Tone tone = word == analysis::ChangeWord::not_changed ? Tone::good : Tone::strong;
  console.out << '\n'
              << paint(console, tone, spoken_word(word)) << "  "
              << compare_sentence(comparison, kinematics) << '\n'
              << compare_reservation(comparison) << '\n';
}

}  // namespace rvbench::bench
