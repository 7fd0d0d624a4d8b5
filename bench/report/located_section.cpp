#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/report/explanation_sections.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::report {
namespace {

constexpr std::size_t most_places = 20;
constexpr std::size_t most_sources = 5;

bool overlap(const analysis::ResidualCluster& a, const analysis::ResidualCluster& b) {
  return a.channel == b.channel && a.locked_to == b.locked_to && a.first <= b.last &&
         b.first <= a.last;
}

std::string off_by(const analysis::ResidualCluster& c) {
  return fmt::format("{:+.3g} {} ({:.0f} σ)", c.apart, xml_escaped(c.unit),
                     std::abs(c.standard_errors));
}

std::string counted(const std::vector<analysis::ResidualCluster>& places) {
  return places.empty() ? "none" : fmt::format("{}", places.size());
}

std::string missing_paragraphs(const MissingForce& missing, const std::string& when) {
  const std::vector<std::string> lines = told(missing, most_sources);
  if (lines.empty()) return {};
  std::string html = paragraph(when);
  for (const std::string& line : lines) html += paragraph(line);
  return html;
}

std::string conditions_of(const analysis::ResidualCluster& c) {
  const std::string& one = c.conditions.front();
  return c.conditions.size() == 1 ? xml_escaped(one)
                                  : fmt::format("{} conditions", c.conditions.size());
}

}  // namespace

std::string located_section(const Located& located) {
  if (located.cells == 0) return {};
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const analysis::ResidualCluster& c, std::string before, std::string after) {
    if (rows.size() < most_places) {
      rows.push_back(
          {xml_escaped(place_text(c)), conditions_of(c), std::move(before), std::move(after)});
    }
  };
  for (const analysis::ResidualCluster& c : located.before) {
    const auto left =
        std::ranges::find_if(located.after, [&](const auto& other) { return overlap(c, other); });
    add(c, off_by(c), left == located.after.end() ? "within chance" : off_by(*left));
  }
  for (const analysis::ResidualCluster& c : located.after) {
    const bool was_there =
        std::ranges::any_of(located.before, [&](const auto& other) { return overlap(c, other); });
    if (!was_there) add(c, "within chance", off_by(c));
  }
  const std::string text = fmt::format(
      "Of {} means and lines, one for each channel and condition, some differ by more than chance. "
      "Lines beside each other are one place: {} as the plant was, {} with what was left out. One "
      "in twenty of these may be wrong.",
      located.cells, counted(located.before), counted(located.after));
  std::string noise;
  for (const Twin::Noise& n : located.noise) noise += (noise.empty() ? "" : "; ") + noise_text(n);
  if (!noise.empty())
    noise = paragraph("Chance, by repeats and by what is beside the lines: " + xml_escaped(noise) +
                      ".");
  return section(
      "Where it differs",
      paragraph(text) + noise +
          (rows.empty() ? "" : table({"where", "under", "farthest off before", "after"}, rows)) +
          missing_paragraphs(located.missing_before, "Where what was left out acts:") +
          missing_paragraphs(located.missing_after, "Where what is left over acts:"));
}

}  // namespace rvbench::bench::report
