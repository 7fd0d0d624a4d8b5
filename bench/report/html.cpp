#include "bench/report/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/report/finding_text.hpp"
#include "bench/xml_text.hpp"
#include "hal/types/units.hpp"

namespace rvbench::bench::report {

std::string section(const std::string& heading, const std::string& body) {
  if (body.empty()) return "";
  return "<section><h2>" + xml_escaped(heading) + "</h2>\n" + body + "</section>\n";
}

std::string table(const std::vector<std::string>& head,
                  const std::vector<std::vector<std::string>>& rows) {
  std::string html = "<div class=\"scroll\"><table><thead><tr>";
  for (const std::string& cell : head) html += "<th>" + cell + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const auto& row : rows) {
    html += "<tr>";
    for (const std::string& cell : row) html += "<td>" + cell + "</td>";
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string number(double value, int significant) {
  if (!std::isfinite(value)) return "–";
  return fmt::format("{:.{}g}", value, significant);
}

std::string order_text(double order, double period_turns) {
  const double events = order * period_turns;
  const bool is_fraction = period_turns > 1 && std::abs(events - std::round(events)) < 0.02;
  if (!is_fraction || std::abs(order - std::round(order)) < 1e-3)
    return fmt::format("{:.4g}", order);
  return fmt::format("{:.4g} ({:.0f}/{:.0f})", order, events, period_turns);
}

std::string frequency_text(double frequency_Hz, double order) {
  const double speed_rpm = units::rpm_from_Hz(frequency_Hz / order);
  return fmt::format("{:.2f} Hz at {:.0f} rpm", frequency_Hz, std::abs(speed_rpm));
}

std::string p_value_text(double p_value) { return xml_escaped(p_text(p_value)); }

std::string spoken(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return xml_escaped(name);
}

std::string paragraph(const std::string& text) { return "<p>" + xml_escaped(text) + "</p>\n"; }

}  // namespace rvbench::bench::report
