#include "bench/unit_numbers.hpp"

#include <algorithm>
#include <cmath>

#include "bench/limit_checks.hpp"
#include "bench/worst_indicator.hpp"
#include "hal/types/measure.hpp"

namespace rvbench::bench {
namespace {

using analysis::Finding;

std::string part_of(const Finding& finding) { return finding.component + ": " + finding.mechanism; }

void add(std::vector<UnitNumber>& numbers, UnitNumber number) {
  if (std::isfinite(number.value)) numbers.push_back(std::move(number));
}

void add_limited(std::vector<UnitNumber>& numbers, const Judgement& judgement) {
  for (const LimitCheck& check : judgement.limits) {
    if (check.measure == measure_names::modulation_depth) continue;  // told part by part
    const bool from_below = std::isfinite(check.min);
    add(numbers, {check.measure, check.of, check.unit, from_below, check.measured, bound_of(check),
                  check.at});
  }
}

void add_depths(std::vector<UnitNumber>& numbers, const std::vector<Finding>& findings) {
  for (const Finding& finding : findings) {
    add(numbers, {std::string(measure_names::modulation_depth), part_of(finding), "1", false,
                  finding.severity, finding.limit});
  }
}

void add_unlimited(std::vector<UnitNumber>& numbers, const Judgement& judgement) {
  for (const Measure& measure : measures()) {
    if (measure.name == measure_names::modulation_depth) continue;
    if (std::ranges::find(judgement.limits, measure.name, &LimitCheck::measure) !=
        judgement.limits.end()) {
      continue;
    }
    const std::string unit(measure.units.front());
    const WorstIndicator worst =
        worst_indicator(judgement, {measure, unit, measure.worst_is_least});
    add(numbers, {std::string(measure.name), "", unit, measure.worst_is_least, worst.value});
  }
}

double depth_in(const analysis::Diagnosis& diagnosis, const std::string& part) {
  if (!diagnosis.resolvable) return not_known;
  for (const Finding* finding : diagnosis.hypotheses()) {
    const bool is_it = std::ranges::any_of(finding->one_of, [&](const std::string& name) {
      return name + ": " + finding->mechanism == part;
    });
    if (!is_it && part_of(*finding) != part) continue;
    if (!finding->points.empty()) return finding->severity;
    return finding->is_open() ? not_known : 0;
  }
  return not_known;
}

}  // namespace

std::string name_of(const UnitNumber& number) {
  return number.measure + (number.of.empty() ? "" : " of " + number.of) + at_text(number.at);
}

double share_of_limit(const UnitNumber& number) {
  if (number.value == number.limit) return 1;  // also of zero
  return number.worst_is_least ? number.limit / number.value : number.value / number.limit;
}

std::vector<UnitNumber> numbers_of(const Judgement& judgement) {
  std::vector<UnitNumber> numbers;
  add_limited(numbers, judgement);
  add_depths(numbers, judgement.diagnosis.findings);
  add_depths(numbers, judgement.diagnosis.below_limit);
  add_unlimited(numbers, judgement);
  return numbers;
}

double value_in(const Judgement& other, const UnitNumber& asked) {
  if (asked.measure == measure_names::modulation_depth) return depth_in(other.diagnosis, asked.of);
  const Measure* measure = find_measure(asked.measure);
  if (measure == nullptr) return not_known;
  return worst_indicator(other, {*measure, asked.unit, asked.worst_is_least, asked.of, asked.at})
      .value;
}

}  // namespace rvbench::bench
