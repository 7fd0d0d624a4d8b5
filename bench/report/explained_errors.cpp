#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "bench/report/explanation_sections.hpp"
#include "bench/report/html.hpp"

namespace rvbench::bench::report {
namespace {

struct Bar {
  std::string label;
  double error;
  const char* style;  // class of the style sheet
};

std::string bars_of(const std::vector<Bar>& bars, bool in_standard_errors) {
  double largest = 0;
  for (const Bar& bar : bars) largest = std::max(largest, bar.error);
  std::string html = "<div class=\"bars\">\n";
  for (const Bar& bar : bars) {
    html += fmt::format(
        "<span>{}</span><span class=\"track\"><i class=\"{}\" style=\"width:{:.1f}%\"></i></span>"
        "<b>{}</b>\n",
        bar.label, bar.style, largest > 0 ? 100 * bar.error / largest : 0,
        analysis::error_text(bar.error, in_standard_errors));
  }
  return html + "</div>\n";
}

}  // namespace

std::string explained_errors_section(const analysis::Explanation& e,
                                     const Comparisons& comparisons) {
  if (comparisons.before.empty()) return {};
  std::vector<Bar> bars{{"the plant as it was", e.held_out_before, "before"}};
  if (!e.effects.empty()) {
    bars.push_back({"with what was left out", e.held_out_after, "after"});
  }
  if (e.ceiling_after.known) {
    bars.push_back({e.self_null.known ? "a law of any shape added"
                                      : "a law of any shape added: the floor",
                    e.ceiling_after.error, "floor"});
  }
  if (e.self_null.known) {
    bars.push_back({"what repeats differ by: the floor", *noise_floor(e), "floor"});
  }
  const std::string metric =
      e.in_standard_errors
          ? "Root mean square of measured minus simulated means and lines, in standard errors "
            "σ of the measurement; far ones count for little more than five. "
          : "Root mean square of measured minus simulated, over the standard deviation of "
            "what was measured. ";
  return section(
      "Error on conditions that were left out, then predicted",
      bars_of(bars, e.in_standard_errors) +
          paragraph(metric + "On what it learned from: " +
                    analysis::error_text(e.trained_before, e.in_standard_errors) + " before, " +
                    analysis::error_text(e.trained_after, e.in_standard_errors) + " after."));
}

}  // namespace rvbench::bench::report
