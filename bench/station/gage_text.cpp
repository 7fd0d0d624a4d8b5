#include "bench/station/gage_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rvbench::bench {
namespace {

constexpr double good_share = 0.1, last_share = 0.3;
constexpr int wanted_categories = 5;

std::string interval_text(const analysis::ConfidenceInterval& interval) {
  return fmt::format("{:.4g} to {:.4g}", interval.low, interval.high);
}

}  // namespace

std::string percent(double share) { return fmt::format("{:.1f} %", 100 * share); }

GageWord word_of(const GageAnswer& answer) {
  double share = answer.study.gage_share;
  if (answer.tolerance) {
    share = std::max(share, analysis::share_of_tolerance(answer.study.gage, *answer.tolerance));
  }
  return share < good_share    ? GageWord::acceptable
         : share <= last_share ? GageWord::conditional
                               : GageWord::not_acceptable;
}

std::string spoken_word(GageWord word) {
  switch (word) {
    case GageWord::acceptable: return "ACCEPTABLE";
    case GageWord::conditional: return "MAY BE ACCEPTABLE";
    case GageWord::not_acceptable: return "NOT ACCEPTABLE";
  }
  return "";
}

std::string gage_sentence(const GageAnswer& answer) {
  const analysis::GageStudy& study = answer.study;
  std::string text =
      fmt::format("The gage makes up {} of the total variation ({:g} %: {} to {})",
                  percent(study.gage_share), 100 * answer.confidence,
                  percent(study.gage_share_interval.low), percent(study.gage_share_interval.high));
  if (answer.tolerance) {
    text += ", " + percent(analysis::share_of_tolerance(study.gage, *answer.tolerance)) +
            " of the tolerance";
  }
  return text + fmt::format(", and tells {} {} of parts apart; {} or more are wanted.",
                            study.distinct_categories(),
                            study.distinct_categories() == 1 ? "category" : "categories",
                            wanted_categories);
}

std::string gage_reservation(const GageAnswer& answer) {
  const analysis::GageReadings& readings = answer.data.readings;
  const analysis::GageAnova& anova = answer.study.anova;
  return fmt::format(
      "{} parts x {} operators x {} trials{}; the interaction of operators and "
      "parts is {} (p = {:.3g}).",
      readings.parts, readings.operators, readings.trials,
      answer.data.unit.empty() ? ", unit not stated" : ", in " + answer.data.unit,
      anova.is_pooled ? "no more than chance, and pooled with repeatability" : "kept apart",
      anova.interaction.p_value);
}

std::vector<std::pair<std::string, analysis::GageComponent>> named_components(
    const analysis::GageStudy& study) {
  std::vector<std::pair<std::string, analysis::GageComponent>> named{
      {"EV repeatability", study.repeatability}, {"AV operators", study.operators}};
  if (!study.anova.is_pooled) named.emplace_back("INT interaction", study.interaction);
  named.emplace_back("GRR gage", study.gage);
  named.emplace_back("PV parts", study.parts);
  return named;
}

void print_gage(Console& console, const GageAnswer& answer) {
  const GageWord word = word_of(answer);
  const Tone tone = word == GageWord::acceptable    ? Tone::good
                    : word == GageWord::conditional ? Tone::warning
                                                    : Tone::bad;
  console.out << paint(console, tone, spoken_word(word)) << "  " << gage_sentence(answer) << '\n'
              << gage_reservation(answer) << "\n\n";
  console.out << fmt::format("{:<18}{:>12}   {:<24}{:>10}", "", "deviation",
                             fmt::format("{:g} % interval", 100 * answer.confidence), "of total");
  console.out << (answer.tolerance ? "  of tolerance\n" : "\n");
  for (const auto& [name, component] : named_components(answer.study)) {
    console.out << fmt::format("{:<18}{:>12.6g}   {:<24}{:>10}", name, component.deviation,
                               interval_text(component.interval),
                               percent(answer.study.share(component)));
    if (answer.tolerance) {
      console.out << fmt::format(
          "{:>14}", percent(analysis::share_of_tolerance(component, *answer.tolerance)));
    }
    console.out << '\n';
  }
  console.out << fmt::format("{:<18}{:>12.6g}\n", "TV total", answer.study.total);
}

}  // namespace rvbench::bench
