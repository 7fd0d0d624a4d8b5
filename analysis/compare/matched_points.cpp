#include "analysis/compare/matched_points.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace rvbench::analysis {
namespace {

constexpr double speed_tolerance =
    1e-2;  // relative: a motor's slip may be left out of a nominal one
constexpr double load_tolerance_pct = 1;

bool is_same_point(const PointRecords& a, double speed_rpm, double load_pct) {
  const double apart = std::abs(a.speed_rpm - speed_rpm);
  const bool same_speed = apart <= speed_tolerance * std::abs(a.speed_rpm) ||
                          (std::isnan(a.speed_rpm) && std::isnan(speed_rpm));
  const bool same_load = std::abs(a.load_pct - load_pct) <= load_tolerance_pct ||
                         (std::isnan(a.load_pct) && std::isnan(load_pct));
  return same_speed && same_load;
}

// NaN compares with nothing: it goes first.
std::tuple<double, double> place(const RecordLevels& record) {
  const auto or_first = [](double x) { return std::isnan(x) ? -HUGE_VAL : x; };
  return {or_first(record.speed_rpm), or_first(record.load_pct)};
}

}  // namespace

std::vector<PointRecords> points_of(const std::vector<RecordLevels>& records) {
  std::vector<std::size_t> rising;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (!records[i].channels.empty()) rising.push_back(i);
  }
  std::ranges::stable_sort(rising, {}, [&](std::size_t i) { return place(records[i]); });
  std::vector<PointRecords> points;
  for (const std::size_t i : rising) {
    const RecordLevels& record = records[i];
    const auto same = std::ranges::find_if(points, [&](const PointRecords& p) {
      return is_same_point(p, record.speed_rpm, record.load_pct);
    });
    if (same != points.end()) {
      same->records.push_back(i);
    } else {
      points.push_back({record.speed_rpm, record.load_pct, {i}});
    }
  }
  for (PointRecords& point : points) std::ranges::sort(point.records);
  return points;
}

MatchedPoints match_points(const std::vector<RecordLevels>& a, const std::vector<RecordLevels>& b) {
  MatchedPoints matched;
  std::vector<PointRecords> others = points_of(b);
  for (PointRecords& point : points_of(a)) {
    const auto same = std::ranges::find_if(others, [&](const PointRecords& p) {
      return is_same_point(point, p.speed_rpm, p.load_pct);
    });
    if (same == others.end()) {
      matched.only_a.push_back(std::move(point));
    } else {
      matched.both.push_back({std::move(point), std::move(*same)});
      others.erase(same);
    }
  }
  matched.only_b = std::move(others);
  return matched;
}

}  // namespace rvbench::analysis
