#include "bench/report/pdf/verdict_page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/report/pdf/figures.hpp"
#include "bench/report/pdf/matrix_block.hpp"
#include "bench/report/pdf/page_parts.hpp"
#include "bench/report/pdf/pages.hpp"
#include "bench/report/sections.hpp"
#include "bench/report/strip_plot.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::pdf {
namespace {

// How much of what there may be too much of.
struct Amount {
  std::size_t findings, limits, strips;
};

// From all that is worth a page down to what fits on one in any case.
constexpr Amount amounts[] = {{4, 8, 4}, {3, 6, 4}, {3, 4, 4}, {2, 4, 4}, {3, 6, 2},
                              {2, 4, 2}, {1, 3, 2}, {1, 2, 0}, {0, 0, 0}};

Blocks strips_of(const Typesetter& typesetter, const ReportInput& input, std::size_t most) {
  std::string text = report::population_text(input);
  if (text.empty()) return {};
  if (!input.population.standings.empty()) text += " A dot is a unit; a hollow one failed.";
  Blocks blocks = part_heading(typesetter, "This unit among earlier ones");
  append(blocks, typesetter.text(xml_escaped(text), small_text, body_width_pt, 2));
  std::vector<std::string> strips;
  for (const Standing& standing : input.population.standings) {
    if (strips.size() < most) strips.push_back(report::strip_plot(standing));
  }
  append(blocks, figure_rows(strips, body_width_pt, 2));
  return blocks;
}

Blocks composed(const Typesetter& typesetter, const ReportInput& input, const Amount& amount) {
  Blocks page = banner(typesetter, input.judgement);
  append(page, facts_table(typesetter, input.judgement));
  append(page, findings_in_words(typesetter, input.judgement, amount.findings));
  const Blocks matrix = matrix_blocks(typesetter, input, body_width_pt);
  if (!matrix.empty()) append(page, part_heading(typesetter, "Points of the plan"));
  append(page, matrix);
  append(page, limits_in_short(typesetter, input.judgement, amount.limits));
  append(page, strips_of(typesetter, input, amount.strips));
  append(page, hashes_to_sign(typesetter, input));
  return page;
}

}  // namespace

Blocks verdict_page(const Typesetter& typesetter, const ReportInput& input) {
  const Block lines = signature_lines(typesetter);
  const double room_pt = body_height_pt - lines.height_pt;
  Blocks page;
  for (const Amount& amount : amounts) {
    page = composed(typesetter, input, amount);
    if (height_pt(page) <= room_pt) break;
  }
  page.push_back(space(std::max(0.0, room_pt - height_pt(page))));
  page.push_back(lines);
  return page;
}

}  // namespace rvbench::bench::pdf
