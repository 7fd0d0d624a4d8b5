#include "bench/judging.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/quality.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/types/units.hpp"

namespace rvbench::bench {
namespace {

constexpr const char* modulation_depth = "modulation_depth";

bool is_about(const sequences::Limit& limit, const std::string& component) {
  return limit.component.empty() || limit.component == component;
}

void check_findings(LimitCheck& check, const sequences::Limit& limit,
                    const std::vector<analysis::Finding>& findings) {
  for (const analysis::Finding& finding : findings) {
    if (!is_about(limit, finding.component)) continue;
    if (std::isnan(check.measured) || finding.severity > check.measured) {
      check.measured = finding.severity;
      check.where = finding.component + ": " + finding.mechanism;
    }
  }
}

// The value of "acceleration_peak" or "acceleration_rms" in the limit's unit; NaN if the channel
// is in another one.
double acceleration_of(const analysis::ChannelExamination& channel, const sequences::Limit& limit) {
  if (channel.unit != "m/s²") return not_known;
  const double m_s2 = limit.measure == "acceleration_peak" ? channel.peak : channel.rms;
  return limit.unit == "g" ? units::g_from_m_s2(m_s2) : m_s2;
}

void check_accelerations(LimitCheck& check, const sequences::Limit& limit,
                         const std::vector<JudgedPoint>& points) {
  for (const JudgedPoint& point : points) {
    for (const analysis::ChannelExamination& channel : point.examination.channels) {
      const double value = acceleration_of(channel, limit);
      if (std::isnan(value) || value <= check.measured) continue;
      check.measured = value;
      check.where = point.examination.source + ", " + channel.name;
    }
  }
}

LimitCheck check_of(const sequences::Limit& limit, const Judgement& judgement) {
  LimitCheck check{limit.measure, limit.component, limit.unit, limit.max, not_known, "",
                   false,         limit.why};
  if (limit.measure == modulation_depth) {
    // Without a finding there is nothing above the noise: a depth of zero, if anything was judged.
    if (judgement.diagnosis.resolvable) check.measured = 0;
    check_findings(check, limit, judgement.diagnosis.findings);
    check_findings(check, limit, judgement.diagnosis.below_limit);
  } else {
    check_accelerations(check, limit, judgement.points);
  }
  check.passed = check.measured <= check.max;
  return check;
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
  if (!judgement.diagnosis.resolvable) {
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
      return invalid(check.measure + " could not be measured in " + check.unit);
    }
    if (!check.passed) {
      return {Outcome::fail, ErrorKind::none,
              fmt::format("{} {:.3g} {} above its limit {:.3g} {} at {}", check.measure,
                          check.measured, check.unit, check.max, check.unit, check.where)};
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

std::vector<hal::ConfigFault> limits_on_unknown_parts(const std::vector<sequences::Limit>& limits,
                                                      const analysis::Kinematics& kinematics) {
  std::vector<std::string> parts;
  for (const analysis::Signature& signature : kinematics.signatures) {
    parts.push_back(signature.component);
  }
  std::vector<hal::ConfigFault> faults;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const std::string& part = limits[i].component;
    if (part.empty() || std::ranges::find(parts, part) != parts.end()) continue;
    faults.push_back({0, fmt::format("/limits/{}/component", i),
                      fmt::format("{} has no {}{}", kinematics.machine, hal::in_quotes(part),
                                  hal::did_you_mean(part, parts))});
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
