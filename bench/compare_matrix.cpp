#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <set>

#include "analysis/compare/compared_channels.hpp"
#include "bench/compare_sections.hpp"
#include "bench/compare_text.hpp"
#include "bench/report/html.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::report {
namespace {

using analysis::Change;
using analysis::ChangeWord;
using analysis::Comparison;

// One channel at one point: lines that are seen, and levels.
struct Square {
  std::size_t compared = 0, changed = 0, not_changed = 0;
  const Change* most = nullptr;  // of those changed
};

std::vector<std::vector<Square>> squares_of(const Comparison& comparison) {
  std::vector<std::vector<Square>> squares(comparison.points.size(),
                                           std::vector<Square>(comparison.channels.size()));
  for (const Change& change : comparison.changes) {
    if (!change.seen) continue;
    Square& square = squares[change.point][change.channel];
    ++square.compared;
    square.not_changed += change.word == ChangeWord::not_changed ? 1 : 0;
    if (change.word != ChangeWord::changed) continue;
    ++square.changed;
    const bool more =
        square.most == nullptr || std::abs(change.change_dB) > std::abs(square.most->change_dB);
    if (more) square.most = &change;
  }
  return squares;
}

std::string span(const char* style, const std::string& title, const std::string& text) {
  return fmt::format("<span class=\"cell {}\" title=\"{}\">{}</span>", style, xml_escaped(title),
                     text);
}

std::string cell_of(const Square& square, const Comparison& comparison) {
  if (square.compared == 0) return span("absent", "not compared", "–");
  const std::string of = fmt::format(" of {} changed", square.compared);
  if (square.most != nullptr) {
    const Change& most = *square.most;
    const std::string title =
        fmt::format("{} {:+.1f} ± {:.2g} dB; {}{}", comparison.quantities[most.quantity].name,
                    most.change_dB, most.uncertainty_dB, square.changed, of);
    return span(most.change_dB > 0 ? "high" : "fell", title,
                fmt::format("{:+.1f}", most.change_dB));
  }
  if (2 * square.not_changed >= square.compared) return span("low", "none" + of, "none");
  return span("spoiled", fmt::format("cannot be told of {}", square.compared - square.not_changed),
              "?");
}

// The head of its column says what they are: twelve channels want the room.
std::string row_name(const analysis::PointRecords& point) {
  const std::string name = analysis::point_text(point.speed_rpm, point.load_pct);
  return xml_escaped(name.ends_with(" load") ? name.substr(0, name.size() - 5) : name);
}

// Twelve names side by side: "accel_1x" may take two lines.
std::string breakable(const std::string& name) {
  std::string html;
  for (const char c : xml_escaped(name)) {
    html += c;
    if (c == '_') html += "<wbr>";
  }
  return html;
}

}  // namespace

std::string compare_matrix_section(const Comparison& comparison) {
  std::vector<std::string> head = {"speed, load"};
  for (const ChannelInfo& channel : comparison.channels) head.push_back(breakable(channel.name));
  std::vector<std::vector<std::string>> rows;
  const auto squares = squares_of(comparison);
  for (std::size_t point = 0; point < squares.size(); ++point) {
    const analysis::PointRecords& at = comparison.points[point].a;
    std::vector<std::string> row = {row_name(at)};
    for (const Square& square : squares[point]) row.push_back(cell_of(square, comparison));
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return "";
  return section(
      "Points and channels",
      paragraph("The largest change of a line or level in each channel at each point, B against A, "
                "in dB; hold the pointer over it to read which, and of how many.") +
          "<div class=\"map\">" + table(head, rows) +
          "<p class=\"note\"><span class=\"cell high\">rose</span> <span class=\"cell "
          "fell\">fell</span> <span class=\"cell low\">none changed</span> <span class=\"cell "
          "spoiled\">cannot tell</span> <span class=\"cell absent\">not "
          "compared</span></p></div>\n");
}

}  // namespace rvbench::bench::report
