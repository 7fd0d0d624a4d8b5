#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>

#include "bench/report/html.hpp"
#include "bench/report/matrix_cell.hpp"
#include "bench/report/sections.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::report {
namespace {

std::string cell_of(const JudgedPoint& point, const analysis::Kinematics& kinematics) {
  const MatrixCell cell = matrix_cell(point, kinematics);
  return fmt::format("<span class=\"cell {}\" title=\"{}\">{}</span>", cell.level,
                     xml_escaped(caption_of(point)), xml_escaped(cell.text));
}

}  // namespace

std::string matrix_section(const ReportInput& input) {
  std::set<double> speeds;
  std::map<double, std::map<double, std::string>, std::greater<>> rows;  // load, then speed
  for (const JudgedPoint& point : input.judgement.points) {
    const double load = point.examination.load_pct;
    if (!std::isfinite(point.planned_speed_rpm) || !std::isfinite(load)) continue;
    speeds.insert(point.planned_speed_rpm);
    rows[load][point.planned_speed_rpm] += cell_of(point, input.kinematics);
  }
  if (speeds.empty()) return "";
  std::vector<std::string> head = {"load"};
  for (const double speed : speeds) head.push_back(fmt::format("{:.0f} rpm", speed));
  std::vector<std::vector<std::string>> cells;
  for (const auto& [load, by_speed] : rows) {
    std::vector<std::string> line = {fmt::format("{:.0f} %", load)};
    for (const double speed : speeds) {
      const auto found = by_speed.find(speed);
      line.push_back(found == by_speed.end() ? "" : found->second);
    }
    cells.push_back(line);
  }
  return section(
      "Matrix of speed and load",
      paragraph("Each box is one record, repeats from left to right. The number is the worst "
                "significant modulation depth in units of its limit; 0 means that no "
                "signature rose above the noise. A loop is a hysteresis test, which has no "
                "modulation. Hatched records cannot be trusted.") +
          "<div class=\"map\">" + table(head, cells) +
          "<p class=\"note\"><span class=\"cell low\">to 0.5</span> <span class=\"cell "
          "mid-level\">0.5 to 1</span> <span class=\"cell high\">above 1</span> <span "
          "class=\"cell spoiled\">not trusted</span> <span class=\"cell absent\">not "
          "recorded</span></p></div>\n");
}

}  // namespace rvbench::bench::report
