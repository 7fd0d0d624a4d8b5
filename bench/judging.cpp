#include "bench/judging.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/indicators/indicator_places.hpp"
#include "analysis/quality.hpp"
#include "bench/limit_checks.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/types/measure.hpp"

namespace rvbench::bench {
namespace {

using measure_names::modulation_depth;

bool is_about(const sequences::Limit& limit, const std::string& component) {
  return limit.component.empty() || limit.component == component;
}

Ending invalid(std::string reason) {
  return {Outcome::invalid, ErrorKind::none, std::move(reason)};
}

// Why the data cannot be trusted; PASS if it can.
Ending trust_in(const Judgement& judgement) {
  int spoiled = 0;
  std::string first;
  for (const JudgedPoint& point : judgement.points) {
    const auto note =
        std::ranges::find_if(point.examination.quality, &analysis::QualityNote::invalidates);
    const bool noted = note != point.examination.quality.end();
    if (point.status == "ok" && !noted) continue;
    if (spoiled++ == 0) {
      first =
          noted ? note->where + ": " + note->what : point.examination.source + ": " + point.status;
    }
  }
  if (spoiled == 1) return invalid(first);
  if (spoiled > 1) {
    return invalid(fmt::format("{} of {} points cannot be trusted; first {}", spoiled,
                               judgement.points.size(), first));
  }
  const bool needs_no_orders =
      !judgement.points.empty() && std::ranges::all_of(judgement.points, [](const JudgedPoint& p) {
        return p.examination.of_hysteresis;
      });
  if (!needs_no_orders && !judgement.diagnosis.resolvable) {
    return invalid("not resolvable: no record is long enough to part the orders of this machine");
  }
  return {Outcome::pass, ErrorKind::none, "no finding above its limit"};
}

// What the limits make of the findings.
Ending weighed(const Judgement& judgement) {
  if (!judgement.diagnosis.findings.empty()) {
    const analysis::Finding& worst = judgement.diagnosis.findings.front();
    return {
        Outcome::fail, ErrorKind::none,
        fmt::format("{}: {} at order {:.4g}, modulation depth {:.2f} above its limit {:.2f}",
                    worst.component, worst.mechanism, worst.order, worst.severity, worst.limit)};
  }
  for (const LimitCheck& check : judgement.limits) {
    if (std::isnan(check.measured)) {
      return invalid(name_of(check) + " could not be measured" +
                     (check.unit == "1" ? "" : " in " + check.unit));
    }
    if (!check.passed) {
      return {Outcome::fail, ErrorKind::none,
              fmt::format("{} {} {} its limit {} at {}", check.measure,
                          with_unit(check.measured, check.unit), beyond(check),
                          with_unit(bound_of(check), check.unit), check.where)};
    }
  }
  return {Outcome::pass, ErrorKind::none, "no finding above its limit"};
}

}  // namespace

analysis::Kinematics with_limits(analysis::Kinematics kinematics,
                                 const std::vector<sequences::Limit>& limits) {
  for (const bool for_one : {false, true}) {
    for (const sequences::Limit& limit : limits) {
      if (limit.measure != modulation_depth || limit.component.empty() == for_one) continue;
      for (analysis::Signature& signature : kinematics.signatures) {
        if (!is_about(limit, signature.component)) continue;
        signature.depth_limit = limit.max;
        signature.limit_why = limit.why;
      }
    }
  }
  return kinematics;
}

analysis::Kinematics of_specimen(analysis::Kinematics kinematics,
                                 const sequences::Specimen& specimen) {
  kinematics.gear_ratio = specimen.gear_ratio;
  kinematics.rated_output_torque_Nm = specimen.rated_output_torque_Nm;
  return kinematics;
}

std::vector<hal::ConfigFault> limits_on_unknown_parts(const std::vector<sequences::Limit>& limits,
                                                      const analysis::Kinematics& kinematics) {
  std::vector<std::string> parts;
  for (const analysis::Signature& signature : kinematics.signatures) {
    parts.push_back(signature.component);
  }
  std::vector<hal::ConfigFault> faults;
  const auto look_up = [&](std::size_t limit, const char* key, const std::string& named,
                           const std::vector<std::string>& known, const std::string& what) {
    if (named.empty() || std::ranges::find(known, named) != known.end()) return;
    faults.push_back({0, fmt::format("/limits/{}/{}", limit, key),
                      fmt::format("{} has no {}{}{}", kinematics.machine, what,
                                  hal::in_quotes(named), hal::did_you_mean(named, known))});
  };
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const std::string& measure = limits[i].measure;
    look_up(i, "component", limits[i].component, parts, "");
    look_up(i, "of", limits[i].of, analysis::places_of(measure, kinematics), measure + " of ");
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
    point.examination = analysis::examine(record, kinematics, options);
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
  std::vector<analysis::Examination> examined;
  for (const JudgedPoint& point : judgement.points) {
    if (point.status == "ok") examined.push_back(point.examination);
  }
  judgement.machine = kinematics.machine;
  judgement.diagnosis = analysis::conclude(examined, kinematics);
  for (const sequences::Limit& limit : limits)
    judgement.limits.push_back(check_of(limit, judgement));
  judgement.ending = graver(graver(weighed(judgement), trust_in(judgement)), measured);
}

void demand_confirmation(Judgement& judgement, const analysis::Kinematics& kinematics) {
  std::vector<analysis::Examination> examined;
  for (const JudgedPoint& point : judgement.points) examined.push_back(point.examination);
  analysis::Diagnosis& diagnosis = judgement.diagnosis;
  if (!diagnosis.resolvable || analysis::shows_machine(examined, diagnosis, kinematics)) return;
  const std::string what =
      "cannot tell: no line of this machine is in the data, so nothing confirms its speed, the "
      "sample rate or that it is this machine";
  diagnosis.quality.push_back({kinematics.machine, what, true});
  judgement.ending = graver(judgement.ending, invalid(kinematics.machine + ": " + what));
}

}  // namespace rvbench::bench
