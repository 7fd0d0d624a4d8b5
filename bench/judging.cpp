#include "bench/judging.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/indicators/earlier_records.hpp"
#include "analysis/indicators/indicator_places.hpp"
#include "analysis/quality/gear_train_fit.hpp"
#include "bench/limit_checks.hpp"
#include "bench/report/finding_text.hpp"
#include "bench/this_machine.hpp"
#include "bench/trust.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/types/measure.hpp"
#include "sequences/limits_on_plan.hpp"

namespace rvbench::bench {
namespace {

using measure_names::modulation_depth;

bool is_about(const sequences::Limit& limit, const std::string& component) {
  return limit.component.empty() || limit.component == component;
}

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

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

// Which part is within its limit, but not surely; empty if all are. Of several the nearest.
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

// What the limits make of the findings. A limit that could not be held against the data outweighs
// one that is exceeded, but both are said.
Ending weighed(const Judgement& judgement) {
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

void refuse_another_machine(Judgement& judgement) {
  if (judgement.not_this_machine.empty()) return;
  judgement.ending =
      graver(judgement.ending,
             invalid(judgement.machine + ": cannot tell: " + judgement.not_this_machine));
}

// What refuses the data is not to be missed behind what was noted of them.
void put_refusals_first(std::vector<analysis::QualityNote>& notes) {
  std::stable_partition(notes.begin(), notes.end(),
                        std::mem_fn(&analysis::QualityNote::invalidates));
}

// An induction motor under load lags by up to so much behind the speed that is on its plate.
constexpr double one_slip = 0.03;

// Where no angle was measured, a stated speed gives way to one within a slip of it that the gear
// train's lines fit so much better that it stands out from all others.
analysis::Examination examined_at_its_speed(const Recording& record,
                                            const analysis::Kinematics& kinematics,
                                            const analysis::ExamineOptions& options) {
  analysis::Examination stated = analysis::examine(record, kinematics, options);
  if (stated.angle_measured || !stated.resolvable || kinematics.meshes.empty()) return stated;
  const double better = analysis::gear_train_fit({stated}, kinematics).best_speed;
  if (!(std::abs(better - 1) <= one_slip)) return stated;
  Recording slipped = record;
  slipped.speed_rpm = better * stated.speed_rpm;
  return analysis::examine(slipped, kinematics, options);
}

// Orders of a record without an angle are counted by the speed that its lines tell.
void tell_speed(const Recording& record, analysis::Examination& e) {
  if (e.angle_measured || !(std::abs(e.speed_rpm - record.speed_rpm) > 0)) return;
  e.quality.push_back(
      {record.source,
       fmt::format(
           "judged at {:.6g} rpm, where the lines of the gear train lie; stated were {:.5g} rpm",
           e.speed_rpm, record.speed_rpm),
       false});
}

// The earlier repeats of a point, at its speed and load, are to NA4 the history of its gears.
void hold_against_earlier(std::vector<JudgedPoint>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<const analysis::Examination*> earlier;
    for (std::size_t j = 0; j < i; ++j) {
      if (points[j].planned_speed_rpm == points[i].planned_speed_rpm &&
          points[j].examination.load_pct == points[i].examination.load_pct) {
        earlier.push_back(&points[j].examination);
      }
    }
    analysis::add_na4(points[i].examination, earlier);
  }
}

}  // namespace

analysis::Kinematics with_limits(analysis::Kinematics kinematics,
                                 const std::vector<sequences::Limit>& limits) {
  for (analysis::Signature& signature : kinematics.signatures) {
    const sequences::Limit* strictest = nullptr;
    for (const sequences::Limit& limit : limits) {
      if (limit.measure != modulation_depth || !is_about(limit, signature.component)) continue;
      if (strictest == nullptr || limit.max < strictest->max) strictest = &limit;
    }
    if (strictest == nullptr) continue;
    signature.depth_limit = signature.noise_limit = strictest->max;
    signature.limit_why = strictest->why;
  }
  return kinematics;
}

std::vector<std::string> parts_of(const analysis::Kinematics& kinematics) {
  std::vector<std::string> parts;
  for (const analysis::Signature& signature : kinematics.signatures) {
    if (!is_among(parts, signature.component)) parts.push_back(signature.component);
  }
  return parts;
}

std::vector<analysis::Examination> examined_points(const Judgement& judgement) {
  std::vector<analysis::Examination> examined;
  for (const JudgedPoint& point : judgement.points) {
    if (point.status == "ok") examined.push_back(point.examination);
  }
  return examined;
}

analysis::Kinematics of_specimen(analysis::Kinematics kinematics,
                                 const sequences::Specimen& specimen) {
  kinematics.gear_ratio = specimen.gear_ratio;
  kinematics.rated_output_torque_Nm = specimen.rated_output_torque_Nm;
  return kinematics;
}

std::vector<hal::ConfigFault> limits_out_of_place(const std::vector<sequences::Limit>& limits,
                                                  const sequences::TestPlan& plan,
                                                  const analysis::Kinematics& kinematics) {
  auto faults = limits_on_unknown_parts(limits, kinematics);
  for (hal::ConfigFault& fault : sequences::limits_without_points(limits, plan)) {
    faults.push_back(std::move(fault));
  }
  return faults;
}

std::vector<hal::ConfigFault> limits_on_unknown_parts(const std::vector<sequences::Limit>& limits,
                                                      const analysis::Kinematics& kinematics) {
  const std::vector<std::string> parts = parts_of(kinematics);
  std::vector<hal::ConfigFault> faults;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const std::string& measure = limits[i].measure;
    const std::string& component = limits[i].component;
    const std::string& of = limits[i].of;
    const auto fault = [&](const char* key, std::string what) {
      faults.push_back({0, fmt::format("/limits/{}/{}", i, key), std::move(what)});
    };
    if (!component.empty() && !is_among(parts, component)) {
      fault("component",
            fmt::format("{} has no {}{}", kinematics.machine, hal::in_quotes(component),
                        hal::what_there_is(component, parts)));
    }
    const std::vector<std::string> places = analysis::places_of(measure, kinematics);
    if (of.empty() || is_among(places, of)) continue;
    fault("of", places.empty() ? fmt::format("{} is of no single part of {}: leave it out", measure,
                                             kinematics.machine)
                               : fmt::format("{} has no {} of {}{}", kinematics.machine, measure,
                                             hal::in_quotes(of), hal::what_there_is(of, places)));
  }
  return faults;
}

JudgedPoint judge_point(const Recording& record, const analysis::Kinematics& kinematics,
                        const analysis::ExamineOptions& options) {
  JudgedPoint point;
  point.status = record.status.empty() ? "ok" : record.status;
  point.planned_speed_rpm = record.planned_speed_rpm;
  point.torque_Nm = record.torque_Nm;
  for (const Channel& channel : record.channels) {
    double& worst = is_of_shaft(channel.info) ? point.torque_time_uncertainty_s
                                              : point.acceleration_time_uncertainty_s;
    worst = std::fmax(worst, channel.time_uncertainty_s);
  }
  if (point.status == "ok") {
    point.examination = examined_at_its_speed(record, kinematics, options);
    tell_speed(record, point.examination);
  } else {
    point.examination.source = record.source;
    point.examination.speed_rpm = record.speed_rpm;
    point.examination.load_pct = record.load_pct;
    point.examination.repeat = record.repeat;
  }
  return point;
}

void conclude(Judgement& judgement, const analysis::Kinematics& kinematics,
              const std::vector<sequences::Limit>& limits, const Ending& measured) {
  hold_against_earlier(judgement.points);
  judgement.machine = kinematics.machine;
  judgement.diagnosis = analysis::conclude(examined_points(judgement), kinematics);
  put_refusals_first(judgement.diagnosis.quality);
  hold_against(judgement, limits, measured);
}

void hold_against(Judgement& judgement, const std::vector<sequences::Limit>& limits,
                  const Ending& measured) {
  judgement.limits.clear();
  for (const sequences::Limit& limit : limits)
    judgement.limits.push_back(check_of(limit, judgement));
  // Of two that are as grave the first: data that cannot be trusted is why a value is missing.
  const Ending trust = trust_in(judgement);
  const Ending judged = weighed(judgement);
  judgement.ending =
      graver(trust.outcome == Outcome::pass ? judged : graver(trust, judged), measured);
  refuse_another_machine(judgement);
}

void demand_confirmation(Judgement& judgement, const analysis::Kinematics& kinematics) {
  analysis::Diagnosis& diagnosis = judgement.diagnosis;
  if (!diagnosis.resolvable) return;
  judgement.not_this_machine = why_not_this_machine(judgement, kinematics);
  if (judgement.not_this_machine.empty()) {
    const std::string caveat = what_confirms_it(judgement, kinematics);
    if (!caveat.empty()) diagnosis.quality.push_back({kinematics.machine, caveat, false});
    return;
  }
  diagnosis.quality.push_back(
      {kinematics.machine, "cannot tell: " + judgement.not_this_machine, true});
  put_refusals_first(diagnosis.quality);
  refuse_another_machine(judgement);
}

}  // namespace rvbench::bench
