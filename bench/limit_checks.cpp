#include "bench/limit_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "bench/worst_indicator.hpp"
#include "hal/types/measure.hpp"

namespace rvbench::bench {
namespace {

bool is_from_below(const LimitCheck& check) { return std::isfinite(check.min); }

std::string_view absent_when(const LimitCheck& check) {
  const Measure* measure = find_measure(check.measure);
  return measure == nullptr ? "" : measure->absent_when;
}

bool is_about(const LimitCheck& check, const analysis::Finding& finding) {
  return check.component.empty() || finding.may_be(check.component);
}

void check_findings(LimitCheck& check, const std::vector<analysis::Finding>& findings) {
  for (const analysis::Finding& finding : findings) {
    if (!is_about(check, finding)) continue;
    if (finding.severity <= check.measured) continue;
    check.measured = finding.severity;
    check.where = finding.component + ": " + finding.mechanism;
  }
}

// Without a finding there is nothing above the noise: a depth of zero, if all that was asked for
// was judged, and noise could not hide more than the limit allows.
void check_depths(LimitCheck& check, const analysis::Diagnosis& diagnosis) {
  if (!diagnosis.resolvable) return;
  check.measured = 0;
  check_findings(check, diagnosis.findings);
  check_findings(check, diagnosis.below_limit);
  const bool open = std::ranges::any_of(diagnosis.not_shown, [&](const analysis::Finding& part) {
    return is_about(check, part) && part.is_open();
  });
  if (open && !is_beyond(check)) check.measured = not_known;
}

void check_indicators(LimitCheck& check, const Judgement& judgement) {
  const Measure* measure = find_measure(check.measure);
  if (measure == nullptr) return;
  WorstIndicator worst =
      worst_indicator(judgement, {*measure, check.unit, is_from_below(check), check.of, check.at});
  check.measured = worst.value;
  check.where = std::move(worst.where);
  check.points = worst.points;
  check.lacking = std::move(worst.lacking);
}

}  // namespace

LimitCheck check_of(const sequences::Limit& limit, const Judgement& judgement) {
  LimitCheck check{limit.measure, limit.component, limit.unit, limit.max, not_known, "",
                   false,         limit.why,       limit.of,   limit.min};
  check.at = limit.at;
  if (limit.measure == measure_names::modulation_depth) {
    check_depths(check, judgement.diagnosis);
  } else {
    check_indicators(check, judgement);
  }
  check.passed = is_measured(check) && !is_beyond(check);
  return check;
}

bool is_measured(const LimitCheck& check) {
  if (std::isnan(check.measured)) return false;
  return check.lacking.empty() || !absent_when(check).empty();
}

bool is_beyond(const LimitCheck& check) {
  return is_from_below(check) ? check.measured < check.min : check.measured > check.max;
}

double bound_of(const LimitCheck& check) { return is_from_below(check) ? check.min : check.max; }

double share_of_bound(const LimitCheck& check) {
  if (!is_measured(check)) return HUGE_VAL;
  const double bound = bound_of(check);
  if (check.measured == bound) return 1;
  return is_from_below(check) ? bound / check.measured : check.measured / bound;
}

const char* bound_name(const LimitCheck& check) { return is_from_below(check) ? "min" : "max"; }

const char* beyond(const LimitCheck& check) { return is_from_below(check) ? "below" : "above"; }

std::string with_unit(double value, const std::string& unit) {
  const std::string number = fmt::format("{:.3g}", value);
  return unit.empty() || unit == "1" ? number : number + " " + unit;
}

std::string bound_text(const LimitCheck& check) {
  return bound_name(check) + (" " + with_unit(bound_of(check), check.unit));
}

std::string name_of(const LimitCheck& check) {
  const std::string& narrowed = check.of.empty() ? check.component : check.of;
  return check.measure + (narrowed.empty() ? "" : " of " + narrowed) + at_text(check.at);
}

std::string coverage_of(const LimitCheck& check) {
  if (check.lacking.empty()) return "";
  return fmt::format("measured at {} of {} points", check.points - check.lacking.size(),
                     check.points);
}

std::string why_unmeasured(const LimitCheck& check) {
  std::string text = "could not be measured";
  if (check.unit != "1") text += " in " + check.unit;
  if (std::isnan(check.measured) && !absent_when(check).empty()) {
    text += fmt::format(": {}", absent_when(check));
  }
  if (std::isnan(check.measured) || check.lacking.empty()) return text;
  return text + fmt::format(" at {} of {} points", check.lacking.size(), check.points);
}

std::string first_lacking(const LimitCheck& check) {
  const bool at_some = !std::isnan(check.measured) && !check.lacking.empty();
  return at_some ? ", first " + check.lacking.front() : "";
}

}  // namespace rvbench::bench
