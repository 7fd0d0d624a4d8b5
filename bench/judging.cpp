#include "bench/judging.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/indicators/earlier_records.hpp"
#include "analysis/indicators/indicator_places.hpp"
#include "analysis/quality/gear_train_fit.hpp"
#include "bench/ending_by_limits.hpp"
#include "bench/limit_checks.hpp"
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

void refuse_another_machine(Judgement& judgement) {
  if (judgement.not_this_machine.empty()) return;
  judgement.ending =
      graver(judgement.ending,
             invalid(judgement.machine + ": cannot tell: " + judgement.not_this_machine));
}

// What refuses the data, or leaves out a channel, is not to be missed behind what was noted of
// them.
void put_refusals_first(std::vector<analysis::QualityNote>& notes) {
  const auto others = std::stable_partition(notes.begin(), notes.end(),
                                            std::mem_fn(&analysis::QualityNote::invalidates));
  std::stable_partition(others, notes.end(), std::mem_fn(&analysis::QualityNote::leaves_out));
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
    signature.set_limit(strictest->max);
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
  const Ending judged = ending_by_limits(judgement);
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
