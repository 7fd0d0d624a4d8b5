#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::report {

std::string correlation_section(const ReportInput& input) {
  std::vector<std::vector<std::string>> rows;
  std::size_t imfs = 0;
  for (const std::size_t i : representative_points(input.judgement)) {
    const JudgedPoint& point = input.judgement.points[i];
    const auto& channel = point.examination.channels[shown_channel(point.examination)];
    if (channel.imf_correlation.empty()) continue;
    std::vector<std::string> row = {xml_escaped(caption_of(point)), xml_escaped(channel.name)};
    for (const double correlation : channel.imf_correlation) {
      row.push_back(std::isfinite(correlation) ? fmt::format("{:.2f}", 100 * correlation) : "–");
    }
    imfs = std::max(imfs, channel.imf_correlation.size());
    rows.push_back(row);
  }
  if (rows.empty()) return "";
  std::vector<std::string> head = {"point", "channel"};
  for (std::size_t k = 1; k <= imfs; ++k) head.push_back(fmt::format("IMF{}", k));
  return section("Correlation of each IMF with the signal [%]",
                 table(head, rows) +
                     shown_points(input.judgement, "verdict.json has those of all points.") +
                     "<p class=\"note\">The article's Table 5 has 62 to 90 % for IMF1 and at most "
                     "7 % for IMF6 to IMF9.</p>\n");
}

}  // namespace rvbench::bench::report
