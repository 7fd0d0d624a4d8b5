#include <cmath>

#include "bench/limit_checks.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/xml_text.hpp"
#include "hal/types/measure.hpp"

namespace rvbench::bench::report {
namespace {

struct Worst {
  double value = not_known;
  double error = not_known;
  std::string unit;
  std::string where;
};

void take_if_worse(Worst& worst, const Measure& measure,
                   const std::vector<analysis::Indicator>& indicators, const std::string& where) {
  for (const analysis::Indicator& i : indicators) {
    if (i.measure != measure.name) continue;
    const bool better = measure.worst_is_least ? i.value >= worst.value : i.value <= worst.value;
    if (better) continue;  // never of what is not known yet: NaN
    worst = {i.value, i.error, i.unit, where + (i.of.empty() ? "" : "; " + i.of)};
  }
}

Worst worst_of(const Measure& measure, const Judgement& judgement) {
  Worst worst;
  for (const JudgedPoint& point : judgement.points) {
    const std::string caption = caption_of(point);
    for (const analysis::ChannelExamination& channel : point.examination.channels) {
      take_if_worse(worst, measure, channel.indicators, caption + "; " + channel.name);
    }
    take_if_worse(worst, measure, point.examination.indicators, caption);
  }
  return worst;
}

// "0.61 ± 0.02", with its 95 % interval where it has one.
std::string text_of(const Worst& worst) {
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
            (check.of.empty() ? "" : " for " + xml_escaped(check.of)) + ": " + state_of(check);
  }
  return html.empty() ? "–" : html;
}

}  // namespace

std::string indicators_section(const ReportInput& input) {
  std::vector<std::vector<std::string>> rows;
  for (const Measure& measure : measures()) {
    const Worst worst = worst_of(measure, input.judgement);
    const std::string limits = limits_on(measure, input.judgement);
    const bool is_finding = measure.name == measure_names::modulation_depth;
    if (is_finding || (std::isnan(worst.value) && limits == "–")) continue;
    rows.push_back({std::string(measure.name), std::string(measure.meaning), text_of(worst),
                    xml_escaped(worst.unit == "1" ? "" : worst.unit), xml_escaped(worst.where),
                    limits});
  }
  if (rows.empty()) return "";
  return section("Indicators",
                 paragraph("The worst of each, over all points and channels. verdict.json has them "
                           "all; a plan can set a limit on each.") +
                     table({"indicator", "meaning", "worst", "unit", "at", "limit"}, rows));
}

}  // namespace rvbench::bench::report
