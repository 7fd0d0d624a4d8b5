#include "analysis/compare/line_level.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/compare/block_floor.hpp"
#include "analysis/spectrum.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index near_lines = 60, line_width = 12;  // slip smears a line
constexpr Eigen::Index lowest_hann = 3;                   // clear of what is left of the mean

struct Reach {
  Eigen::Index from, to;
};

// Middles within reach that have a neighbour to both sides.
std::optional<Reach> reach_of(const Spectrum& spectrum, double order, double within,
                              Eigen::Index lowest) {
  const double middle = order / spectrum.resolution;
  const auto half = static_cast<Eigen::Index>(std::ceil(within / spectrum.resolution - 1e-9));
  const auto line = static_cast<Eigen::Index>(std::lround(middle));
  const Reach reach{line - half, line + half};
  if (reach.from < lowest || reach.to + 1 >= spectrum.amplitude.size()) return std::nullopt;
  return reach;
}

// Noise near a line that was searched for: a resonance may stand within the wider floor, and is no
// line.
struct NearNoise {
  double power, lines;
};

NearNoise near_noise(const LineFloor& floor, double blocks, Eigen::Index line) {
  std::vector<double> values;
  const Eigen::Index from = std::max<Eigen::Index>(line - near_lines, lowest_hann);
  const Eigen::Index to = std::min(line + near_lines, floor.power.size() - 1);
  for (Eigen::Index i = from; i <= to; ++i) {
    if (std::abs(i - line) > line_width && floor.is_neighbour(i)) values.push_back(floor.power[i]);
  }
  if (values.empty()) return {0, 1};
  const double worth = floor.floor_lines[line] / std::max(1.0, floor.neighbours[line]);
  const double lines = std::max(1.0, worth * static_cast<double>(values.size()));
  return {median(std::move(values)) / noise_median(blocks), lines};
}

}  // namespace

std::optional<LineLevel> line_level(const Spectrum& spectrum, const LineFloor& floor, double blocks,
                                    double order, double within, double searched) {
  const auto reach = reach_of(spectrum, order, within, lowest_hann);
  if (!reach) return std::nullopt;
  LineLevel level;
  Eigen::Index highest = reach->from;
  for (Eigen::Index i = reach->from; i <= reach->to; ++i) {
    level.power = std::max(level.power, floor.power.segment(i - 1, 3).sum() / lines_per_hann_line);
    if (floor.power[i] > floor.power[highest]) highest = i;
  }
  NearNoise noise{floor.floor[highest], floor.floor_lines[highest]};
  if (reach->to > reach->from) {
    const NearNoise near = near_noise(floor, blocks, highest);
    if (near.power > noise.power) noise = near;
  }
  level.above_floor = floor.power[highest] / noise.power;
  const double chances = 2 * std::ceil(std::max(within, searched) / spectrum.resolution - 1e-9) + 1;
  level.p_value = std::min(
      1.0, chances * line_p_value(blocks * level.above_floor, blocks, blocks * noise.lines));
  return level;
}

std::optional<double> single_line_power(const Spectrum& spectrum, double order, double within) {
  const auto reach = reach_of(spectrum, order, within, 1);
  if (!reach) return std::nullopt;
  const double most =
      spectrum.amplitude.segment(reach->from, reach->to - reach->from + 1).maxCoeff();
  return most * most;
}

}  // namespace rvbench::analysis
