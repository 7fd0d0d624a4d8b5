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
  std::vector<std::vector<Square>> squares(comparison.channels.size(),
                                           std::vector<Square>(comparison.points.size()));
  for (const Change& change : comparison.changes) {
    if (!change.is_seen()) continue;
    Square& square = squares[change.channel][change.point];
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

}  // namespace

std::string compare_matrix_section(const Comparison& comparison) {
  std::vector<std::string> head = {"channel"};
  for (const analysis::MatchedPoint& point : comparison.points) {
    head.push_back(xml_escaped(analysis::point_text(point.a.speed_rpm, point.a.load_pct)));
  }
  std::vector<std::vector<std::string>> rows;
  const auto squares = squares_of(comparison);
  for (std::size_t channel = 0; channel < squares.size(); ++channel) {
    std::vector<std::string> row = {xml_escaped(comparison.channels[channel].name)};
    for (const Square& square : squares[channel]) row.push_back(cell_of(square, comparison));
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
