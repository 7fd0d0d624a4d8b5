#include <algorithm>
#include <cmath>

#include "bench/limit_checks.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/worst_indicator.hpp"
#include "bench/xml_text.hpp"
#include "hal/types/measure.hpp"

namespace rvbench::bench::report {
namespace {

// What the first limit on a measure is in, or, without one, what it is measured in.
std::string unit_of(const Measure& measure, const Judgement& judgement) {
  const auto limit = std::ranges::find(judgement.limits, measure.name, &LimitCheck::measure);
  return limit == judgement.limits.end() ? std::string(measure.units.front()) : limit->unit;
}

// The units that a measure's values are compared in: that of its limit for all that leads there,
// and what an unknown sensor gives by itself.
std::vector<std::string> units_of(const Measure& measure, const Judgement& judgement) {
  const std::string own = unit_of(measure, judgement);
  std::vector<std::string> units;
  const auto add = [&](const std::vector<analysis::Indicator>& indicators) {
    for (const analysis::Indicator& i : indicators) {
      if (i.measure != measure.name) continue;
      const std::string unit = std::isnan(in_unit(i.value, i.unit, own)) ? i.unit : own;
      if (std::ranges::find(units, unit) == units.end()) units.push_back(unit);
    }
  };
  for (const JudgedPoint& point : judgement.points) {
    for (const analysis::ChannelExamination& channel : point.examination.channels) {
      add(channel.indicators);
    }
    add(point.examination.indicators);
  }
  return units;
}

// "0.61 ± 0.02", with its 95 % interval where it has one.
std::string text_of(const WorstIndicator& worst) {
  return number(worst.value) + (std::isfinite(worst.error) ? " ± " + number(worst.error, 2) : "");
}

// "≤ 4 for pin-lobe pass: within"; one line per limit of the plan.
std::string limits_on(const Measure& measure, const Judgement& judgement) {
  std::string html;
  for (const LimitCheck& check : judgement.limits) {
    if (check.measure != measure.name) continue;
    html += html.empty() ? "" : "<br>";
    html += std::string(std::isfinite(check.min) ? "≥ " : "≤ ") +
            xml_escaped(with_unit(bound_of(check), check.unit)) +
            (check.of.empty() ? "" : " for " + xml_escaped(check.of)) + at_text(check.at) + ": " +
            state_of(check);
  }
  return html.empty() ? "–" : html;
}

}  // namespace

std::string indicators_section(const ReportInput& input) {
  const Judgement& judgement = input.judgement;
  std::vector<std::vector<std::string>> rows;
  for (const Measure& measure : measures()) {
    if (measure.name == measure_names::modulation_depth) continue;  // of a finding
    const std::string limits = limits_on(measure, judgement);
    std::vector<std::string> units = units_of(measure, judgement);
    if (units.empty() && limits != "–") units.push_back(unit_of(measure, judgement));
    for (const std::string& unit : units) {
      const WorstIndicator worst =
          worst_indicator(judgement, {measure, unit, measure.worst_is_least});
      rows.push_back({std::string(measure.name), std::string(measure.meaning), text_of(worst),
                      xml_escaped(unit == "1" ? "" : unit),
                      xml_escaped(readable_place(judgement, worst.where)), limits});
    }
  }
  if (rows.empty()) return "";
  return section("Indicators",
                 paragraph("The worst of each, over all points and channels. verdict.json has them "
                           "all; a plan can set a limit on each.") +
                     table({"indicator", "meaning", "worst", "unit", "at", "limit"}, rows));
}

}  // namespace rvbench::bench::report
