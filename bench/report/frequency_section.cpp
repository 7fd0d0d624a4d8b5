#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "analysis/table4.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "hal/types/units.hpp"

namespace rvbench::bench::report {
namespace {

constexpr std::size_t speeds_in_table = 4, most_speeds = 16;

// The points of one planned speed.
struct SpeedGroup {
  double speed_rpm = 0;  // measured, mean of the group
  std::vector<const analysis::Examination*> points;
};

std::vector<SpeedGroup> groups_of(const Judgement& judgement) {
  std::map<double, SpeedGroup> groups;
  for (const JudgedPoint& point : judgement.points) {
    const double measured = point.examination.speed_rpm;
    if (point.status != "ok" || !std::isfinite(measured)) continue;
    const bool planned = std::isfinite(point.planned_speed_rpm);
    SpeedGroup& group = groups[planned ? point.planned_speed_rpm : std::round(measured)];
    group.points.push_back(&point.examination);
    group.speed_rpm += (measured - group.speed_rpm) / double(group.points.size());
  }
  std::vector<SpeedGroup> list;
  for (auto& [speed, group] : groups) list.push_back(std::move(group));
  return list;
}

// How far a line may be from `order` and still be it: well inside the spacing of 1/period.
double tolerance_at(double order, const analysis::Kinematics& kinematics) {
  return kinematics.period_turns > 1 ? 0.35 / kinematics.period_turns : 0.01 * order;
}

// How far slip, or an error of the speed, has moved a signature's lines: 1 where they are nominal.
double stretch_of(const analysis::SignatureScore& score, const analysis::Kinematics& kinematics) {
  return score.order / kinematics.signatures[static_cast<std::size_t>(score.signature)].order;
}

// The deepest significant envelope line and the strongest spectral line at `order`.
std::string found_at(double order, const SpeedGroup& group,
                     const analysis::Kinematics& kinematics) {
  const double tolerance = tolerance_at(order, kinematics);
  double depth = 0;
  double depth_order = not_known;
  double amplitude = 0;
  double line_Hz = not_known;
  for (const analysis::Examination* point : group.points) {
    for (const analysis::SignatureScore& score : point->scores) {
      const std::size_t lines = std::min(score.line_orders.size(), score.line_depths.size());
      const double stretch = stretch_of(score, kinematics);
      for (std::size_t i = 0; score.p_value < analysis::significant_p && i < lines; ++i) {
        if (std::abs(score.line_orders[i] / stretch - order) > tolerance ||
            score.line_depths[i] <= depth) {
          continue;
        }
        depth = score.line_depths[i];
        depth_order = score.line_orders[i];
      }
    }
    for (const analysis::ChannelExamination& channel : point->channels) {
      for (const analysis::SpectralLine& line : channel.lines) {
        if (std::abs(line.order - order) > tolerance || line.amplitude <= amplitude) continue;
        amplitude = line.amplitude;
        line_Hz = line.frequency_Hz;
      }
    }
  }
  std::string text;
  if (depth > 0) {
    text = fmt::format("{:.2f} (envelope, depth {:.3f})",
                       depth_order * units::Hz_from_rpm(std::abs(group.speed_rpm)), depth);
  }
  if (amplitude > 0)
    text +=
        fmt::format("{}{:.2f} (line, {})", text.empty() ? "" : "<br>", line_Hz, number(amplitude));
  return text.empty() ? "–" : text;
}

const analysis::Table4Row* published_row(const std::string& item) {
  const auto& rows = analysis::table4();
  const auto* row = std::ranges::find_if(rows, [&](const auto& r) { return r.item == item; });
  return row == rows.end() ? nullptr : row;
}

std::string published_text(const analysis::CharacteristicOrder& line) {
  const analysis::Table4Row* row = published_row(line.table4_item);
  if (row == nullptr) return "–";
  return fmt::format("{:.1f} / {:.1f} / {:.1f}", row->frequency_Hz[0], row->frequency_Hz[1],
                     row->frequency_Hz[2]);
}

// What the article states and no kinematics gives: quoted, not reproduced.
std::string published_unexplained() {
  return "<h3>Published, unexplained</h3>\n" +
         table({"published", "why it is not reproduced"},
               {{"minor peaks at 3.6 / 7.1 / 10.3 Hz (605 / 1210 / 1815 rpm)",
                 "3 to 11 % above every kinematic line of the cycloid stage; motor slip would move "
                 "them down, not up"},
                {"10 Hz at 1210 rpm", "order 1/2 of the input shaft has no kinematic source"}}) +
         paragraph(
             "Table 4 is shown as published. Its meshing row fits a motor 3.0 / 2.5 / 2.3 % below "
             "nominal speed (slip), its drive-shaft row is the sun against the carrier (120/121), "
             "the others fit nominal speed: the table mixes speeds. Here lines are matched in "
             "orders of the measured speed.");
}

// A table of these speeds, and of none if there are none.
std::string frequency_table(std::span<const SpeedGroup> groups,
                            const analysis::Kinematics& kinematics, bool has_published) {
  std::vector<std::string> head = {"item", "order"};
  if (has_published) head.push_back("published [Hz]<br>605 / 1210 / 1815 rpm");
  for (const SpeedGroup& group : groups) {
    head.push_back(fmt::format("derived [Hz]<br>{:.1f} rpm", group.speed_rpm));
    head.push_back(fmt::format("found [Hz]<br>{:.1f} rpm", group.speed_rpm));
  }
  std::vector<std::vector<std::string>> rows;
  for (const analysis::CharacteristicOrder& line : kinematics.orders) {
    std::vector<std::string> row = {spoken(line.name),
                                    order_text(line.order, kinematics.period_turns)};
    if (has_published) row.push_back(published_text(line));
    for (const SpeedGroup& group : groups) {
      row.push_back(
          fmt::format("{:.2f}", line.order * units::Hz_from_rpm(std::abs(group.speed_rpm))));
      row.push_back(found_at(line.order, group, kinematics));
    }
    rows.push_back(row);
  }
  return table(head, rows);
}

// A table is as wide as a page can show: more speeds are more tables.
std::string frequency_tables(std::span<const SpeedGroup> groups,
                             const analysis::Kinematics& kinematics, bool has_published) {
  const auto shown = groups.first(std::min(groups.size(), most_speeds));
  std::string html = frequency_table(shown.first(std::min(shown.size(), speeds_in_table)),
                                     kinematics, has_published);
  for (std::size_t at = speeds_in_table; at < shown.size(); at += speeds_in_table) {
    const auto count = std::min(shown.size() - at, speeds_in_table);
    html += frequency_table(shown.subspan(at, count), kinematics, false);
  }
  if (shown.size() == groups.size()) return html;
  return html +
         paragraph(fmt::format(
             "Shown are the {} lowest of {} speeds; the others are {:.1f} to {:.1f} rpm. "
             "verdict.json has the lines that were found at each point.",
             shown.size(), groups.size(), groups[shown.size()].speed_rpm, groups.back().speed_rpm));
}

}  // namespace

std::string frequency_section(const ReportInput& input) {
  const analysis::Kinematics& kinematics = input.kinematics;
  if (kinematics.orders.empty()) return "";
  const bool has_published = std::ranges::any_of(kinematics.orders, [](const auto& line) {
    return published_row(line.table4_item) != nullptr;
  });
  return section(
      "Characteristic frequencies",
      paragraph(
          "Derived at the measured mean speed. Found: envelope lines of significant signatures, "
          "with their modulation depth, and lines of the spectrum itself, with their amplitude.") +
          frequency_tables(groups_of(input.judgement), kinematics, has_published) +
          (has_published ? published_unexplained() : ""));
}

}  // namespace rvbench::bench::report
