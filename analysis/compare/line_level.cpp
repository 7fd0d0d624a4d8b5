#include "analysis/compare/line_level.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr double hann_noise_lines = 1.5;
constexpr Eigen::Index lowest_hann = 3;  // clear of what is left of the mean

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

}  // namespace

std::optional<LineLevel> line_level(const Spectrum& spectrum, const LineFloor& floor, double blocks,
                                    double order, double within) {
  const auto reach = reach_of(spectrum, order, within, lowest_hann);
  if (!reach) return std::nullopt;
  LineLevel level;
  Eigen::Index highest = reach->from;
  for (Eigen::Index i = reach->from; i <= reach->to; ++i) {
    level.power = std::max(level.power, floor.power.segment(i - 1, 3).sum() / hann_noise_lines);
    if (floor.power[i] > floor.power[highest]) highest = i;
  }
  level.above_floor = floor.power[highest] / floor.floor[highest];
  const double searched = static_cast<double>(reach->to - reach->from + 1);
  level.p_value = std::min(1.0, searched * line_p_value(blocks * level.above_floor, blocks,
                                                        blocks * floor.floor_lines[highest]));
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
