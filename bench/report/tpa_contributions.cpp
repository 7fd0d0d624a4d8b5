#include <fmt/format.h>

#include <algorithm>

#include "bench/report/html.hpp"
#include "bench/report/svg_plot.hpp"
#include "bench/report/tpa_sections.hpp"
#include "bench/tpa_text.hpp"
#include "bench/xml_text.hpp"
#include "hal/types/units.hpp"

namespace rvbench::bench::report {
namespace {

using Places = std::vector<DegreeOfFreedom>;

constexpr int wide_px = 960, high_px = 220;

std::string title_of(const BandAnswer& answer, const MotionAnswer& motion) {
  return target_name(answer.ranking.target, motion.contributions.targets) + ", " +
         band_text(answer.ranking.band) + ": " + answer_text(answer, motion.contributions.paths);
}

// Bars in the order of the paths, as the article has them; the leader, if one leads, stands out.
std::string histogram(const BandAnswer& answer, const MotionAnswer& motion,
                      const std::string& unit) {
  const Places& paths = motion.contributions.paths;
  std::vector<PlotGroup> groups(paths.size());
  Eigen::VectorXd highs(Eigen::Index(paths.size()));
  for (std::size_t rank = 0; rank < answer.ranking.paths.size(); ++rank) {
    const analysis::BandContribution& path = answer.ranking.paths[rank];
    const analysis::Interval95& interval = answer.certainty.rms[rank];
    const bool stands_out = rank == 0 && answer.word == LeadWord::leads;
    groups[std::size_t(path.path)] = {
        path_label(path.path, paths),
        {{path.rms, interval.low, interval.high, stands_out ? "before" : "after"}}};
    highs[path.path] = std::max(path.rms, interval.high);
  }
  SvgPlot plot(title_of(answer, motion), {"path", 0, double(groups.size())},
               axis_around("contribution [" + unit + "]", highs), wide_px, high_px);
  plot.add_groups(groups);
  return "<div class=\"wide\">" + plot.svg() + "</div>\n";
}

std::vector<std::string> row_of(const BandAnswer& answer, const MotionAnswer& motion) {
  const auto& [ranking, certainty, word] = answer;
  const Places& paths = motion.contributions.paths;
  const analysis::BandContribution& first = ranking.paths.front();
  const analysis::Interval95& interval = certainty.rms.front();
  std::string second = "–", held = "–";
  if (ranking.paths.size() > 1) {
    second = fmt::format("{} {}", xml_escaped(path_name(ranking.paths[1].path, paths)),
                         number(ranking.paths[1].rms));
    held = fmt::format("{:.0f} %", 100 * certainty.order_held.front());
  }
  return {xml_escaped(target_name(ranking.target, motion.contributions.targets)),
          band_text(ranking.band),
          word == LeadWord::leads ? "<b>" + xml_escaped(path_name(first.path, paths)) + "</b>"
                                  : "cannot tell",
          fmt::format("{} {}", xml_escaped(path_name(first.path, paths)), number(first.rms)),
          fmt::format("{} to {}", number(interval.low), number(interval.high)),
          fmt::format("{:.0f}°", first.phase_rad / units::degree_rad),
          second,
          held,
          number(ranking.validation_score),
          fmt::format("{} / {}", number(ranking.measured_rms), number(ranking.synthesised_rms))};
}

}  // namespace

std::string contributions_part(const MotionAnswer& motion, const std::string& unit) {
  std::vector<std::vector<std::string>> rows;
  std::string figures;
  for (const BandAnswer& answer : motion.answers) {
    rows.push_back(row_of(answer, motion));
    figures += histogram(answer, motion, unit);
  }
  return table({"target", "band", "leads", "largest [" + xml_escaped(unit) + "]", "95 %", "phase",
                "second", "order held", "validation", "measured / sum of paths"},
               rows) +
         figures;
}

}  // namespace rvbench::bench::report
