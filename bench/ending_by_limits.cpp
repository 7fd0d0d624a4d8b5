#include "bench/ending_by_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bench/limit_checks.hpp"
#include "bench/report/finding_text.hpp"
#include "bench/trust.hpp"
#include "hal/types/measure.hpp"

namespace rvbench::bench {
namespace {

using measure_names::modulation_depth;

// The first thing that is beyond its limit; empty if nothing is.
std::string first_beyond(const Judgement& judgement) {
  if (!judgement.diagnosis.findings.empty()) {
    const analysis::Finding& worst = judgement.diagnosis.findings.front();
    return fmt::format("{}: {} at order {:.4g}, modulation depth {:.3g} above its limit {:.3g}{}",
                       worst.component, worst.mechanism, worst.order, worst.severity, worst.limit,
                       report::is_close(worst) ? ", but not surely" : "");
  }
  const auto check = std::ranges::find_if(judgement.limits, is_beyond);
  if (check == judgement.limits.end()) return "";
  const std::string points = check->at.is_any() ? "" : at_text(check->at) + ":";
  return fmt::format("{}{} {} {} its {} at {}", check->measure, points,
                     with_unit(check->measured, check->unit), beyond(*check), bound_text(*check),
                     check->where);
}

// The first part that is neither shown nor known to be within its limit; empty if there is none.
std::string first_open(const analysis::Diagnosis& diagnosis) {
  const auto open = std::ranges::find_if(diagnosis.not_shown, &analysis::Finding::is_open);
  if (!diagnosis.resolvable || open == diagnosis.not_shown.end()) return "";
  const std::string part = "cannot tell " + open->component + ": " + open->mechanism;
  if (std::isnan(open->severity_high)) {
    return part + fmt::format(": no line of its order {:.4g} can be read", open->order);
  }
  if (open->severity_high > open->smallest_visible) {
    return part + fmt::format(": too few points show it, as deep as {:.3g}, its limit is {:.3g}",
                              open->severity_high, open->limit);
  }
  return part + fmt::format(": noise hides depths up to {:.3g}, its limit is {:.3g}",
                            open->severity_high, open->limit);
}

// Lines that modulate a mesh and belong to no part: the kinematics are not this machine's, and no
// name that they give can be trusted.
bool is_of_another_machine(const analysis::UnknownFamily& family) { return family.sidebands > 0; }

// Damage-like lines of no part of the machine: first those that tell of another machine. Null if
// there are none.
const analysis::UnknownFamily* first_unknown(const analysis::Diagnosis& diagnosis) {
  if (diagnosis.unknown.empty()) return nullptr;
  const auto beside_mesh = std::ranges::find_if(diagnosis.unknown, is_of_another_machine);
  return beside_mesh == diagnosis.unknown.end() ? &diagnosis.unknown.front() : &*beside_mesh;
}

std::string unknown_text(const analysis::UnknownFamily& family) {
  return fmt::format(
      "unknown: {} harmonics of order {:.4g} follow the shaft as {} does, and no part of this "
      "machine has it",
      family.harmonics, family.spacing, family.is_locked ? "a gear" : "a rolling bearing");
}

// The part that comes nearest to its limit where it may as well be beyond it; empty if none does.
std::string nearest_within(const analysis::Diagnosis& diagnosis) {
  const analysis::Finding* nearest = nullptr;
  for (const analysis::Finding& finding : diagnosis.below_limit) {
    if (!report::is_close(finding)) continue;
    const auto share = [](const analysis::Finding& f) { return f.severity / f.limit; };
    if (nearest == nullptr || share(finding) > share(*nearest)) nearest = &finding;
  }
  if (nearest == nullptr) return "";
  return fmt::format("; {}: {} is {}, but not surely", nearest->component, nearest->mechanism,
                     report::limit_text(*nearest));
}

// Beside a part that is bad the depth of others may not be told. That is no flaw of the data.
bool is_hidden(const LimitCheck& check, const analysis::Diagnosis& diagnosis) {
  return check.measure == modulation_depth && diagnosis.resolvable && !diagnosis.findings.empty();
}

}  // namespace

Ending ending_by_limits(const Judgement& judgement) {
  const std::string bad = first_beyond(judgement);
  const auto unmeasured = std::ranges::find_if(judgement.limits, [&](const LimitCheck& check) {
    return !is_measured(check) && !is_hidden(check, judgement.diagnosis);
  });
  if (unmeasured != judgement.limits.end()) {
    return invalid(name_of(*unmeasured) + " " + why_unmeasured(*unmeasured) +
                   first_lacking(*unmeasured) + (bad.empty() ? "" : "; beside it " + bad));
  }
  const analysis::UnknownFamily* unknown = first_unknown(judgement.diagnosis);
  if (unknown != nullptr && is_of_another_machine(*unknown)) {
    return invalid(unknown_text(*unknown) + (bad.empty() ? "" : "; beside it " + bad));
  }
  if (!bad.empty()) return {Outcome::fail, ErrorKind::none, bad};
  if (unknown != nullptr) return invalid(unknown_text(*unknown));
  if (const std::string open = first_open(judgement.diagnosis); !open.empty()) return invalid(open);
  return {Outcome::pass, ErrorKind::none,
          "no finding above its limit" + nearest_within(judgement.diagnosis)};
}

}  // namespace rvbench::bench
