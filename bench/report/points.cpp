#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::bench::report {
namespace {

constexpr std::size_t most_points = 6;
constexpr double full_load_pct = 100;

bool is_good(const JudgedPoint& point) {
  return point.status == "ok" && !point.examination.channels.empty();
}

struct Choice {
  std::vector<std::size_t> points;
  std::size_t good = 0;  // points there are to choose from
  std::vector<std::string> speeds_rpm, other_speeds_rpm;
};

// The one with the least load and the one nearest to full load, which may be the same.
std::vector<std::size_t> least_and_full_load(const std::vector<std::size_t>& of,
                                             const Judgement& judgement) {
  const auto load = [&](std::size_t i) { return judgement.points[i].examination.load_pct; };
  const auto from_full = [&](std::size_t i) { return std::abs(load(i) - full_load_pct); };
  const std::size_t least = *std::ranges::min_element(of, {}, load);
  const std::size_t full = *std::ranges::min_element(of, {}, from_full);
  return full == least ? std::vector{least} : std::vector{least, full};
}

// Evenly from the first to the last of `count`, for neither end of the speeds is to be left out.
bool is_chosen(std::size_t i, std::size_t count, std::size_t most) {
  for (std::size_t k = 0; count > most && k < most; ++k) {
    if (i == k * (count - 1) / (most - 1)) return true;
  }
  return count <= most;
}

Choice choice_of(const Judgement& judgement) {
  std::map<double, std::vector<std::size_t>> by_speed;
  std::vector<std::size_t> unplanned;
  Choice choice;
  for (std::size_t i = 0; i < judgement.points.size(); ++i) {
    const JudgedPoint& point = judgement.points[i];
    if (!is_good(point)) continue;
    ++choice.good;
    const bool planned =
        std::isfinite(point.planned_speed_rpm) && std::isfinite(point.examination.load_pct);
    (planned ? by_speed[point.planned_speed_rpm] : unplanned).push_back(i);
  }
  std::size_t each = 1;
  for (auto& [speed, points] : by_speed) {
    points = least_and_full_load(points, judgement);
    each = std::max(each, points.size());
  }
  std::size_t i = 0;
  for (const auto& [speed, points] : by_speed) {
    const bool chosen = is_chosen(i++, by_speed.size(), most_points / each);
    (chosen ? choice.speeds_rpm : choice.other_speeds_rpm).push_back(fmt::format("{:g}", speed));
    if (chosen) choice.points.insert(choice.points.end(), points.begin(), points.end());
  }
  if (by_speed.empty()) choice.points = std::move(unplanned);
  if (choice.points.size() > most_points) choice.points.resize(most_points);
  return choice;
}

}  // namespace

std::vector<std::size_t> representative_points(const Judgement& judgement) {
  return choice_of(judgement).points;
}

std::string shown_points(const Judgement& judgement, const std::string& others) {
  const Choice choice = choice_of(judgement);
  if (choice.points.size() == choice.good) return "";
  const std::string count = fmt::format("{} of {}", choice.points.size(), choice.good);
  if (choice.speeds_rpm.empty())
    return paragraph("Shown are the first " + count + " records. " + others);
  std::string text = fmt::format(
      "Shown are {} points: at {} rpm, the first good record with the least load and the one "
      "nearest to 100 % load. ",
      count, hal::listed(choice.speeds_rpm));
  if (!choice.other_speeds_rpm.empty()) {
    text += "None is at " + hal::listed(choice.other_speeds_rpm) + " rpm. ";
  }
  return paragraph(text + others);
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
