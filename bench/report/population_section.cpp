#include <fmt/format.h>

#include "bench/findings_stand.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/report/strip_plot.hpp"

namespace rvbench::bench::report {

std::string population_text(const ReportInput& input) {
  const RunFacts& facts = input.judgement.facts;
  if (facts.serial.empty() || facts.plan.empty()) return "";  // a stored recording is of no unit
  if (!findings_stand(input.judgement)) {
    return "Not compared with earlier units: nothing is said about this one.";
  }
  const Population& population = input.population;
  const std::size_t units = population.units();
  if (units < least_population) {
    return fmt::format("No population yet: {} earlier unit{} of plan {}, and it takes {}.", units,
                       units == 1 ? "" : "s", facts.plan, least_population);
  }
  std::string text = fmt::format(
      "n = {} earlier units of plan {}, of which {} passed and {} failed; of each its last run "
      "before this one.",
      units, facts.plan, population.passed, population.failed);
  if (units == most_earlier_units) text += " There may be more: these are the latest.";
  if (population.standings.empty()) text += " None of this unit's numbers is known of enough.";
  return text;
}

std::string population_section(const ReportInput& input) {
  const std::string text = population_text(input);
  if (text.empty()) return "";
  std::string strips;
  for (const Standing& standing : input.population.standings) {
    strips += "<figure style=\"margin:0\">" + strip_plot(standing) + "</figure>\n";
  }
  if (strips.empty()) return section("This unit among earlier ones", paragraph(text));
  return section(
      "This unit among earlier ones",
      paragraph(text) + "<div class=\"figures\">\n" + strips + "</div>\n" +
          "<p class=\"note\">A dot is a unit: filled, it passed; hollow, it failed. Shown "
          "are the numbers nearest to their limit, and those without a limit that are "
          "farthest out.</p>\n");
}

}  // namespace rvbench::bench::report
