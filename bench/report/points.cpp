#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/report/sections.hpp"

namespace rvbench::bench::report {
namespace {

constexpr std::size_t most_points = 6;
constexpr double full_load_pct = 100;

bool is_good(const JudgedPoint& point) {
  return point.status == "ok" && !point.examination.channels.empty();
}

}  // namespace

std::vector<std::size_t> representative_points(const Judgement& judgement) {
  std::map<double, std::vector<std::size_t>> by_speed;
  std::vector<std::size_t> unplanned;
  for (std::size_t i = 0; i < judgement.points.size(); ++i) {
    const JudgedPoint& point = judgement.points[i];
    if (!is_good(point)) continue;
    const bool planned =
        std::isfinite(point.planned_speed_rpm) && std::isfinite(point.examination.load_pct);
    (planned ? by_speed[point.planned_speed_rpm] : unplanned).push_back(i);
  }
  const auto load = [&](std::size_t i) { return judgement.points[i].examination.load_pct; };
  const auto from_full = [&](std::size_t i) { return std::abs(load(i) - full_load_pct); };
  std::vector<std::size_t> chosen;
  for (const auto& [speed, points] : by_speed) {
    const std::size_t no_load = *std::ranges::min_element(points, {}, load);
    const std::size_t full_load = *std::ranges::min_element(points, {}, from_full);
    chosen.push_back(no_load);
    if (full_load != no_load) chosen.push_back(full_load);
  }
  if (chosen.empty()) chosen = unplanned;
  if (chosen.size() > most_points) chosen.resize(most_points);
  return chosen;
}

std::size_t shown_channel(const analysis::Examination& examination) {
  const auto strongest = std::ranges::max_element(examination.scores, {},
                                                  &analysis::SignatureScore::log_likelihood_ratio);
  if (strongest != examination.scores.end() && strongest->p_value < analysis::significant_p) {
    const auto channel = static_cast<std::size_t>(std::max(0, strongest->channel));
    if (channel < examination.channels.size()) return channel;
  }
  const auto loudest =
      std::ranges::max_element(examination.channels, {}, &analysis::ChannelExamination::rms);
  return static_cast<std::size_t>(loudest - examination.channels.begin());
}

std::string caption_of(const JudgedPoint& point) {
  const analysis::Examination& seen = point.examination;
  if (!std::isfinite(point.planned_speed_rpm)) return seen.source;
  return fmt::format("{:.0f} rpm, {:.0f} % load, repeat {}", point.planned_speed_rpm, seen.load_pct,
                     seen.repeat);
}

std::string readable_place(const Judgement& judgement, const std::string& where) {
  for (const JudgedPoint& point : judgement.points) {
    const std::string& source = point.examination.source;
    if (!source.empty() && (where == source || where.starts_with(source + ", ")))
      return caption_of(point) + where.substr(source.size());
  }
  return where;
}

}  // namespace rvbench::bench::report
