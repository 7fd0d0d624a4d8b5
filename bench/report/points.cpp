#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "bench/findings_stand.hpp"
#include "bench/limit_checks.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::bench::report {
namespace {

constexpr std::size_t most_points = 6;
constexpr std::size_t most_telling = 2;
constexpr double full_load_pct = 100;

bool is_good(const JudgedPoint& point) {
  return point.status == "ok" && !point.examination.channels.empty();
}

bool is_planned(const JudgedPoint& point) {
  return std::isfinite(point.planned_speed_rpm) && std::isfinite(point.examination.load_pct);
}

// Whether a place is the point, or one of its channels: "recording.h5#004, accel_2x".
bool is_at(const JudgedPoint& point, const std::string& place) {
  const std::string& source = point.examination.source;
  return !source.empty() && (place == source || place.starts_with(source + ", "));
}

bool contains(const std::vector<std::size_t>& points, std::size_t i) {
  return std::ranges::find(points, i) != points.end();
}

struct Choice {
  std::vector<std::size_t> points;
  std::size_t good = 0;  // points there are to choose from
  std::vector<std::string> speeds_rpm, other_speeds_rpm;
  // Captions of points that the verdict has its reasons from: beside those that stand for all, and
  // in place of some of them.
  std::vector<std::string> besides, replacing, replaced;
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

// Of each speed those that stand for it.
Choice spread_out(const Judgement& judgement) {
  std::map<double, std::vector<std::size_t>> by_speed;
  std::vector<std::size_t> unplanned;
  Choice choice;
  for (std::size_t i = 0; i < judgement.points.size(); ++i) {
    const JudgedPoint& point = judgement.points[i];
    if (!is_good(point)) continue;
    ++choice.good;
    (is_planned(point) ? by_speed[point.planned_speed_rpm] : unplanned).push_back(i);
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

// The good point of a place, if it is one.
std::optional<std::size_t> point_of(const Judgement& judgement, const std::string& place) {
  const auto point = std::ranges::find_if(
      judgement.points, [&](const JudgedPoint& there) { return is_at(there, place); });
  if (point == judgement.points.end() || !is_good(*point)) return std::nullopt;
  return static_cast<std::size_t>(point - judgement.points.begin());
}

// Where the verdict has its reasons: the good points that show each finding which stands, and where
// each limit that was broken was left farthest.
std::vector<std::vector<std::size_t>> reasons_of(const Judgement& judgement) {
  std::vector<std::vector<std::string>> places;
  if (findings_stand(judgement)) {
    for (const analysis::Finding& finding : judgement.diagnosis.findings) {
      places.push_back(finding.points);
    }
  }
  for (const LimitCheck& check : judgement.limits) {
    if (is_beyond(check)) places.push_back({check.where});
  }
  std::vector<std::vector<std::size_t>> reasons;
  for (const std::vector<std::string>& of_one : places) {
    std::vector<std::size_t> points;
    for (const std::string& place : of_one) {
      if (const auto point = point_of(judgement, place)) points.push_back(*point);
    }
    if (!points.empty()) reasons.push_back(std::move(points));
  }
  return reasons;
}

// Which of the points that stand for all gives way to another one: of those that no reason is read
// at, one of the same speed rather than another's only one, and of these the last.
std::optional<std::size_t> least_needed(const std::vector<std::size_t>& usual, std::size_t other,
                                        const std::vector<std::vector<std::size_t>>& reasons,
                                        const Judgement& judgement) {
  const auto speed = [&](std::size_t i) { return judgement.points[i].planned_speed_rpm; };
  const auto need = [&](std::size_t i) {
    if (speed(i) == speed(other)) return 0;
    const auto alike = [&](std::size_t one) { return speed(one) == speed(i); };
    return std::ranges::count_if(usual, alike) > 1 ? 1 : 2;
  };
  std::optional<std::size_t> least;
  for (const std::size_t i : usual) {
    const bool is_reason =
        std::ranges::any_of(reasons, [&](const auto& points) { return contains(points, i); });
    if (!is_reason && (!least || need(i) <= need(*least))) least = i;
  }
  return least;
}

Choice choice_of(const Judgement& judgement) {
  Choice choice = spread_out(judgement);
  std::vector<std::size_t> usual = choice.points;
  const auto reasons = reasons_of(judgement);
  for (const std::vector<std::size_t>& points : reasons) {
    const bool is_shown =
        std::ranges::any_of(points, [&](std::size_t i) { return contains(choice.points, i); });
    if (is_shown || choice.besides.size() + choice.replacing.size() == most_telling) continue;
    const std::size_t telling = points.front();
    const std::string caption = caption_of(judgement.points[telling]);
    if (choice.points.size() < most_points) {
      choice.besides.push_back(caption);
    } else if (const auto least = least_needed(usual, telling, reasons, judgement)) {
      std::erase(usual, *least);
      std::erase(choice.points, *least);
      choice.replacing.push_back(caption);
      choice.replaced.push_back(caption_of(judgement.points[*least]));
    } else {
      continue;
    }
    choice.points.push_back(telling);
    std::erase(choice.other_speeds_rpm,
               fmt::format("{:g}", judgement.points[telling].planned_speed_rpm));
  }
  std::ranges::stable_sort(choice.points, {}, [&](std::size_t i) {
    const double speed_rpm = judgement.points[i].planned_speed_rpm;
    return std::isfinite(speed_rpm) ? speed_rpm : 0;
  });
  return choice;
}

}  // namespace

std::vector<std::size_t> representative_points(const Judgement& judgement) {
  return choice_of(judgement).points;
}

std::string shown_points(const Judgement& judgement, const std::string& others) {
  const Choice choice = choice_of(judgement);
  if (choice.points.size() == choice.good) return "";
  const std::size_t usual = choice.points.size() - choice.besides.size();
  std::string text =
      choice.speeds_rpm.empty()
          ? fmt::format("Shown are the first {} of {} records. ", usual, choice.good)
          : fmt::format(
                "Shown are {} of {} points: at {} rpm, the first good record with the least load "
                "and the one nearest to 100 % load. ",
                usual, choice.good, hal::listed(choice.speeds_rpm));
  const char* const read = "where a finding or a broken limit was read";
  if (!choice.besides.empty()) {
    text += fmt::format("Besides, {}: {}. ", read, fmt::join(choice.besides, "; "));
  }
  if (!choice.replacing.empty()) {
    text += fmt::format("In place of {}, {}: {}. ", fmt::join(choice.replaced, "; "), read,
                        fmt::join(choice.replacing, "; "));
  }
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
    if (is_at(point, where)) {
      return caption_of(point) + where.substr(point.examination.source.size());
    }
  }
  return where;
}

}  // namespace rvbench::bench::report
