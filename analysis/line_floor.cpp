#include "analysis/line_floor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index neighbours = 160;  // to either side
constexpr Eigen::Index stride = 32;       // the floor is taken anew this often, and held between
constexpr Eigen::Index dense = 16;        // locked lines this near to each other are everywhere

bool is_clean(Eigen::Index line, Eigen::Index locked_every) {
  if (locked_every < 4) return true;  // too dense to step around
  const Eigen::Index away = line % locked_every;
  return away >= 2 && away <= locked_every - 2;
}

double floor_around(const Eigen::VectorXd& power, Eigen::Index line, Eigen::Index locked_every) {
  const Eigen::Index from = std::max<Eigen::Index>(1, line - neighbours);
  const Eigen::Index to = std::min(power.size() - 1, line + neighbours);
  std::vector<double> values;
  for (Eigen::Index i = from; i <= to; ++i) {
    if (is_clean(i, locked_every)) values.push_back(power[i]);
  }
  return values.empty() ? 0 : median(std::move(values)) / std::numbers::ln2;
}

}  // namespace

bool LineFloor::is_locked(Eigen::Index line) const {
  return locked_every >= dense && !is_clean(line, locked_every);
}

LineFloor line_floor(const Spectrum& spectrum, Eigen::Index locked_every) {
  LineFloor result;
  result.locked_every = locked_every;
  result.power = spectrum.amplitude.cwiseAbs2();
  const Eigen::Index n = result.power.size();
  result.floor.resize(n);
  // A constant signal has no floor; the least positive number keeps ratios finite.
  const double least =
      std::max(result.power.maxCoeff() * 1e-24, std::numeric_limits<double>::min() * 1e8);
  for (Eigen::Index from = 0; from < n; from += stride) {
    const Eigen::Index count = std::min(stride, n - from);
    const double floor = floor_around(result.power, from + count / 2, locked_every);
    result.floor.segment(from, count).setConstant(std::max(floor, least));
  }
  const double share =
      locked_every < 4 ? 1.0
                       : static_cast<double>(locked_every - 3) / static_cast<double>(locked_every);
  // Neighbouring Hann lines share two thirds of their noise, a median uses half of what it is
  // given.
  result.floor_lines = 2.0 * static_cast<double>(neighbours) * share / 1.5 * 0.48;
  return result;
}

}  // namespace rvbench::analysis
