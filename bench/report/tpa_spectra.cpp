#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/frf/signed_axis.hpp"
#include "bench/report/html.hpp"
#include "bench/report/svg_plot.hpp"
#include "bench/report/tpa_sections.hpp"
#include "bench/tpa_text.hpp"

namespace rvbench::bench::report {
namespace {

using Eigen::Index;
using Spectrum = Eigen::VectorXd;

constexpr double shown_dB = 80;  // below the largest
constexpr std::size_t most_forces = 4;

// Levels; what is silent, or a line that was left out, is a gap.
Spectrum in_dB(const Spectrum& amplitudes) {
  return amplitudes.unaryExpr(
      [](double amplitude) { return amplitude > 0 ? 20 * std::log10(amplitude) : not_known; });
}

PlotAxis frequency_axis(const analysis::LineGrid& grid) {
  return {"frequency [Hz]", grid.first_Hz, grid.frequency_Hz(std::max<Index>(grid.lines - 1, 1))};
}

PlotAxis level_axis(const std::string& unit, const Spectrum& a, const Spectrum& b) {
  const double largest =
      std::fmax(a.maxCoeff<Eigen::PropagateNumbers>(), b.maxCoeff<Eigen::PropagateNumbers>());
  const double top = largest > 0 ? 5 * std::ceil(20 * std::log10(largest) / 5) : 0;
  return {"level [dB re 1 " + unit + "]", top - shown_dB, top + 2};
}

std::string two_spectra(const std::string& title, const analysis::LineGrid& grid,
                        const std::string& unit, const Spectrum& first, const char* first_style,
                        const Spectrum& second) {
  SvgPlot plot(title, frequency_axis(grid), level_axis(unit, first, second));
  plot.add_trace(grid.first_Hz, grid.step_Hz, in_dB(first), first_style);
  plot.add_trace(grid.first_Hz, grid.step_Hz, in_dB(second), "after");
  return plot.svg();
}

std::string legend(const char* first_style, const char* first, const char* second) {
  return fmt::format(
      "<p class=\"legend\"><span><i class=\"{}\"></i>{}</span><span><i class=\"after\"></i>{}"
      "</span></p>\n",
      first_style, first, second);
}

analysis::LineMatrices synthesised_targets(const analysis::PathContributions& contributions) {
  auto sum = contributions.measured_targets;
  for (Index line = 0; line < sum.lines; ++line) sum[line] = contributions.synthesised(line);
  return sum;
}

// Paths that are first anywhere, each once.
std::vector<Index> first_paths(const MotionAnswer& motion) {
  std::vector<Index> paths;
  for (const BandAnswer& answer : motion.answers) {
    const Index path = answer.ranking.paths.front().path;
    if (std::ranges::find(paths, path) == paths.end() && paths.size() < most_forces) {
      paths.push_back(path);
    }
  }
  return paths;
}

std::string one_trace(const std::string& title, const analysis::LineGrid& grid, PlotAxis y,
                      const Spectrum& values) {
  SvgPlot plot(title, frequency_axis(grid), std::move(y));
  plot.add_trace(grid.first_Hz, grid.step_Hz, values);
  return plot.svg();
}

std::string figures(const std::string& svgs) {
  return "<div class=\"figures\">" + svgs + "</div>\n";
}

std::string inversion_figures(const analysis::PathContributions& found) {
  const Spectrum decades = found.conditions.array().log10().unaryExpr(
      [](double value) { return std::isfinite(value) ? value : not_known; });
  Spectrum kept(found.grid.lines);
  for (Index line = 0; line < kept.size(); ++line) {
    kept[line] = double(found.rules[std::size_t(line)].kept);
  }
  return one_trace("condition number of the FRFs to indicators", found.grid,
                   axis_around("logarithm to base 10", decades), decades) +
         one_trace(fmt::format("singular values kept, of {}", found.forces.rows), found.grid,
                   {"number", 0, double(found.forces.rows) + 1}, kept);
}

// Where forces are not known: how far references can be told apart.
std::string references_part(const MotionAnswer& motion) {
  const analysis::PathContributions& found = motion.contributions;
  return "<h3>References</h3>\n" +
         figures(one_trace(fmt::format("independent ways in which the {} moved", found.forces.rows),
                           found.grid, {"number", 0, double(found.forces.rows) + 1},
                           motion.findings.ways));
}

}  // namespace

std::string validation_part(const MotionAnswer& motion, const std::string& unit) {
  const analysis::PathContributions& found = motion.contributions;
  const analysis::OnBoardValidation& validation = found.validation;
  const Eigen::MatrixXd unused = mean_amplitudes(validation.measured().values);
  const Eigen::MatrixXd unused_sum = mean_amplitudes(validation.synthesised());
  std::string svgs;
  const analysis::TpaBand all{found.grid.first_Hz, found.grid.frequency_Hz(found.grid.lines - 1)};
  for (Index i = 0; i < unused.rows(); ++i) {
    svgs += two_spectra(fmt::format("{}, not fitted to: score {:.3f}",
                                    analysis::name_of(validation.measured().places[std::size_t(i)]),
                                    validation.score(all, i)),
                        found.grid, unit, unused.row(i), "measured", unused_sum.row(i));
  }
  const Eigen::MatrixXd targets = mean_amplitudes(found.measured_targets);
  const Eigen::MatrixXd targets_sum = mean_amplitudes(synthesised_targets(found));
  for (Index i = 0; i < targets.rows(); ++i) {
    svgs += two_spectra("target " + target_name(i, found.targets), found.grid, unit, targets.row(i),
                        "measured", targets_sum.row(i));
  }
  return "<h3>Validation</h3>\n" + legend("measured", "measured", "sum of the paths") +
         figures(svgs);
}

std::string forces_part(const MotionAnswer& motion, const TpaFrfs& frfs) {
  const analysis::PathContributions& found = motion.contributions;
  if (motion.findings.ways.size() > 0) return references_part(motion);
  const Eigen::MatrixXd forces = mean_amplitudes(found.forces);
  std::string svgs;
  for (const Index path : first_paths(motion)) {
    const Spectrum force = forces.row(path);
    svgs += one_trace("force at " + path_name(path, found.paths), found.grid,
                      level_axis(frfs.matrix.excitation_unit, force, force), in_dB(force));
  }
  if (!found.rules.empty()) svgs += inversion_figures(found);
  return "<h3>Forces</h3>\n" + figures(svgs);
}

std::string repair_part(const MotionAnswer& motion, const TpaStudy& study) {
  if (!motion.repair) return "";
  const analysis::LineGrid& grid = motion.contributions.grid;
  std::string svgs;
  for (Index target = 0; target < motion.repair->before.rows(); ++target) {
    svgs += two_spectra(
        fmt::format("target {}: {} over {}", target_name(target, motion.contributions.targets),
                    level_change_text(change_dB(*motion.repair, target, 0)),
                    band_text(study.project.bands.front())),
        grid, study.frfs.matrix.response_unit, motion.repair->before.row(target), "before",
        motion.repair->after.row(target));
  }
  return "<h3>" + spoken(motion.motion.name) + "</h3>\n" + legend("before", "before", "after") +
         figures(svgs);
}

}  // namespace rvbench::bench::report
