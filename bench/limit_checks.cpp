#include "bench/limit_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "hal/types/measure.hpp"

namespace rvbench::bench {
namespace {

bool is_from_below(const LimitCheck& check) { return std::isfinite(check.min); }

void take_if_worse(LimitCheck& check, double value, const std::string& where) {
  if (std::isnan(value)) return;
  const bool better = is_from_below(check) ? value >= check.measured : value <= check.measured;
  if (better) return;  // never of what is not measured yet: NaN
  check.measured = value;
  check.where = where;
}

void check_findings(LimitCheck& check, const std::vector<analysis::Finding>& findings) {
  for (const analysis::Finding& finding : findings) {
    if (!check.component.empty() && check.component != finding.component) continue;
    take_if_worse(check, finding.severity, finding.component + ": " + finding.mechanism);
  }
}

void check_indicators(LimitCheck& check, const std::vector<analysis::Indicator>& indicators,
                      const std::string& where) {
  for (const analysis::Indicator& indicator : indicators) {
    if (indicator.measure != check.measure) continue;
    if (!check.of.empty() && check.of != indicator.of) continue;
    const double value = in_unit(indicator.value, indicator.unit, check.unit);
    take_if_worse(check, value, where + (indicator.of.empty() ? "" : ", " + indicator.of));
  }
}

}  // namespace

LimitCheck check_of(const sequences::Limit& limit, const Judgement& judgement) {
  LimitCheck check{limit.measure, limit.component, limit.unit, limit.max, not_known, "",
                   false,         limit.why,       limit.of,   limit.min};
  if (limit.measure == measure_names::modulation_depth) {
    // Without a finding there is nothing above the noise: a depth of zero, if anything was judged.
    if (judgement.diagnosis.resolvable) check.measured = 0;
    check_findings(check, judgement.diagnosis.findings);
    check_findings(check, judgement.diagnosis.below_limit);
  } else {
    for (const JudgedPoint& point : judgement.points) {
      const analysis::Examination& seen = point.examination;
      for (const analysis::ChannelExamination& channel : seen.channels) {
        check_indicators(check, channel.indicators, seen.source + ", " + channel.name);
      }
      check_indicators(check, seen.indicators, seen.source);
    }
  }
  check.passed = is_from_below(check) ? check.measured >= check.min : check.measured <= check.max;
  return check;
}

double bound_of(const LimitCheck& check) { return is_from_below(check) ? check.min : check.max; }

const char* beyond(const LimitCheck& check) { return is_from_below(check) ? "below" : "above"; }

std::string with_unit(double value, const std::string& unit) {
  const std::string number = fmt::format("{:.3g}", value);
  return unit.empty() || unit == "1" ? number : number + " " + unit;
}

std::string name_of(const LimitCheck& check) {
  const std::string& narrowed = check.of.empty() ? check.component : check.of;
  return check.measure + (narrowed.empty() ? "" : " of " + narrowed);
}

}  // namespace rvbench::bench
