#include "sequences/limits_on_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rvbench::sequences {
namespace {

// Whether the phase records what the measure is made of: a shaft that is wound to and fro tells of
// nothing that turns, and one that turns of no torsion.
bool shows(const Phase& phase, const Measure& measure) {
  if (phase.points().empty()) return false;
  if (!measure.phase.empty()) return phase.kind() == measure.phase;
  return std::ranges::find(measures(), phase.kind(), &Measure::phase) == measures().end();
}

// With repeats, in the order of the plan.
std::vector<SetPoint> recorded_points(const Measure& measure, const TestPlan& plan) {
  std::vector<SetPoint> points;
  for (const auto& phase : plan.main) {
    if (!shows(*phase, measure)) continue;
    for (const hal::PlannedPoint& p : phase->points()) points.push_back({p.speed_rpm, p.load_pct});
  }
  return points;
}

std::string texts_of(const std::vector<SetPoint>& points) {
  std::string text;
  for (const SetPoint& point : points) text += (text.empty() ? "" : "; ") + text_of(point);
  return text;
}

}  // namespace

std::vector<SetPoint> set_points_of(const Measure& measure, const TestPlan& plan) {
  const std::vector<SetPoint> recorded = recorded_points(measure, plan);
  std::vector<SetPoint> points;
  for (const SetPoint& point : recorded) {
    if (std::ranges::find(points, point) != points.end()) continue;
    if (measure.takes_repeats && std::ranges::count(recorded, point) < 2) continue;
    points.push_back(point);
  }
  return points;
}

std::optional<LimitMismatch> mismatch_of(const Limit& limit, const TestPlan& plan) {
  const Measure& measure = *find_measure(limit.measure);
  if (recorded_points(measure, plan).empty()) {
    return LimitMismatch{
        "measure",
        limit.measure + (measure.phase.empty()
                             ? " needs a shaft that turns steadily, which main never records"
                             : fmt::format(" needs a {} phase, and main has none", measure.phase))};
  }
  const std::vector<SetPoint> points = set_points_of(measure, plan);
  if (points.empty()) {
    return LimitMismatch{"measure",
                         limit.measure + " needs a point that main records more than once"};
  }
  const auto holds = [&](const SetPoint& point) { return overlap(limit.at, point); };
  if (std::ranges::any_of(points, holds)) return std::nullopt;
  return LimitMismatch{limit.at.speed_rpm ? "speed_rpm" : "load_pct",
                       fmt::format("no point of the plan shows {}{}: there are {}", limit.measure,
                                   at_text(limit.at), texts_of(points))};
}

std::vector<hal::ConfigFault> limits_without_points(const std::vector<Limit>& limits,
                                                    const TestPlan& plan) {
  std::vector<hal::ConfigFault> faults;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (const auto mismatch = mismatch_of(limits[i], plan)) {
      faults.push_back({0, fmt::format("/limits/{}/{}", i, mismatch->key), mismatch->why});
    }
  }
  return faults;
}

}  // namespace rvbench::sequences
