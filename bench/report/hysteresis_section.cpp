#include <fmt/format.h>

#include "analysis/indicators/hysteresis_record.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/report/svg_plot.hpp"
#include "bench/xml_text.hpp"
#include "hal/types/units.hpp"

namespace rvbench::bench::report {
namespace {

using analysis::HysteresisLoop;
using units::arcmin_from_rad;

// Torsion from the middle of the lost motion.
double from_middle_arcmin(const HysteresisLoop& loop, double torsion_rad) {
  return arcmin_from_rad(torsion_rad - (loop.minus_rad + loop.plus_rad) / 2);
}

// The torsion that all loops span, symmetric about their middles.
PlotAxis torsion_axis(const std::vector<HysteresisLoop>& loops) {
  double most = 0;
  for (const HysteresisLoop& loop : loops) {
    const double last_rad = loop.first_rad + loop.step_rad * double(loop.rising_Nm.size() - 1);
    most = std::max(
        {most, -from_middle_arcmin(loop, loop.first_rad), from_middle_arcmin(loop, last_rad)});
  }
  return {"torsion at the output [arcmin]", -1.05 * most, 1.05 * most};
}

// Of all branches of all loops: what an axis leaves out is drawn at its edge.
Eigen::VectorXd torques_Nm(const std::vector<HysteresisLoop>& loops) {
  std::vector<double> all;
  for (const HysteresisLoop& loop : loops) {
    all.insert(all.end(), loop.rising_Nm.begin(), loop.rising_Nm.end());
    all.insert(all.end(), loop.falling_Nm.begin(), loop.falling_Nm.end());
  }
  return Eigen::VectorXd::Map(all.data(), static_cast<Eigen::Index>(all.size()));
}

std::string loop_figure(const std::string& caption, const std::vector<HysteresisLoop>& loops) {
  SvgPlot plot("Hysteresis: " + caption, torsion_axis(loops),
               axis_around("torque at the output [N·m]", torques_Nm(loops)), 540, 380);
  for (const HysteresisLoop& loop : loops) {
    const double first = from_middle_arcmin(loop, loop.first_rad);
    const double step = arcmin_from_rad(loop.step_rad);
    plot.add_trace(first, step, loop.rising_Nm);
    plot.add_trace(first, step, loop.falling_Nm);
    plot.add_trace(first, step, loop.passed_Nm(), "before");
  }
  plot.add_mark(from_middle_arcmin(loops.front(), loops.front().minus_rad), "−3 %");
  plot.add_mark(from_middle_arcmin(loops.front(), loops.front().plus_rad), "+3 %");
  return "<figure style=\"margin:0\">" + plot.svg() + "</figure>\n";
}

}  // namespace

std::string hysteresis_section(const ReportInput& input) {
  if (!input.load) return "";
  std::string figures;
  for (std::size_t i = 0; i < input.judgement.points.size(); ++i) {
    const JudgedPoint& point = input.judgement.points[i];
    if (!point.examination.of_hysteresis) continue;
    const std::optional<Recording> record = input.load(i);
    if (!record) continue;
    const analysis::Hysteresis told = analysis::hysteresis_of(*record, input.kinematics);
    if (!told.loops.empty()) figures += loop_figure(caption_of(point), told.loops);
  }
  if (figures.empty()) return "";
  return section("Hysteresis",
                 paragraph("Torque over torsion while the input is wound to and fro against a held "
                           "output, every loop; between the branches, what the reducer passes on: "
                           "friction is half of what parts them. The lost motion lies between the "
                           "marks, where 3 % of the rated torque is passed on.") +
                     "<div class=\"figures\">\n" + figures + "</div>\n");
}

}  // namespace rvbench::bench::report
