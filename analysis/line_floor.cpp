#include "analysis/line_floor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index fewest_neighbours = 16;  // to either side
constexpr Eigen::Index most_neighbours = 160;
constexpr Eigen::Index dense = 16;  // locked lines this near to each other are everywhere

bool is_clean(Eigen::Index line, Eigen::Index locked_every) {
  if (locked_every < 4) return true;  // too dense to step around
  const Eigen::Index away = line % locked_every;
  return away >= 2 && away <= locked_every - 2;
}

// Lines to either side that the floor of `line` is taken from: from line 32 on, half its distance
// to line 0 at the most, as the noise of an envelope falls with frequency.
Eigen::Index neighbours_of(Eigen::Index line) {
  return std::clamp(line / 2, fewest_neighbours, most_neighbours);
}

// The powers of the clean lines, one behind the other.
class CleanLines {
 public:
  template <typename IsClean>
  CleanLines(const Eigen::VectorXd& power, IsClean is_clean)
      : before_(std::size_t(power.size()) + 1) {
    powers_.reserve(std::size_t(power.size()));
    for (Eigen::Index line = 0; line < power.size(); ++line) {
      before_[std::size_t(line)] = std::ptrdiff_t(powers_.size());
      if (is_clean(line)) powers_.push_back(power[line]);
    }
    before_.back() = std::ptrdiff_t(powers_.size());
  }

  std::vector<double> around(Eigen::Index line) const {
    const Eigen::Index neighbours = neighbours_of(line);
    const Eigen::Index last = std::ssize(before_) - 2;
    const Eigen::Index from = std::clamp<Eigen::Index>(line - neighbours, 1, last + 1);
    const Eigen::Index end = std::max(from, std::min(last, line + neighbours) + 1);
    return {powers_.begin() + before_[std::size_t(from)],
            powers_.begin() + before_[std::size_t(end)]};
  }

 private:
  std::vector<double> powers_;
  std::vector<std::ptrdiff_t> before_;  // of each line, and of all
};

template <typename IsClean>
LineFloor floor_of(const Spectrum& spectrum, IsClean is_clean) {
  LineFloor result;
  result.power = spectrum.amplitude.cwiseAbs2();
  const Eigen::Index n = result.power.size();
  result.floor.resize(n);
  // A constant signal has no floor; the least positive number keeps ratios finite.
  const double least =
      std::max(result.power.maxCoeff() * 1e-24, std::numeric_limits<double>::min() * 1e8);
  result.floor_lines.resize(n);
  result.neighbours.resize(n);
  const CleanLines clean(result.power, is_clean);
  double middle = 0;  // of the surroundings before
  // The floor is taken anew every tenth of its surroundings, and held between.
  for (Eigen::Index from = 0; from < n;) {
    const Eigen::Index count = std::min(neighbours_of(from) / 5, n - from);
    std::vector<double> values = clean.around(from + count / 2);
    result.neighbours.segment(from, count).setConstant(static_cast<double>(values.size()));
    // Neighbouring Hann lines share two thirds of their noise, a median uses half of what it is
    // given.
    result.floor_lines.segment(from, count)
        .setConstant(std::max(1.0, static_cast<double>(values.size()) / 1.5 * 0.48));
    middle = values.empty() ? 0 : median_near(middle, std::move(values));
    result.floor.segment(from, count).setConstant(std::max(middle / std::numbers::ln2, least));
    from += count;
  }
  return result;
}

}  // namespace

double LineFloor::log_ratio(Eigen::Index line) const {
  const double m = floor_lines[line];
  return m * std::log1p(power[line] / (m * floor[line]));
}

bool LineFloor::is_neighbour(Eigen::Index line) const { return is_clean(line, locked_every); }

bool LineFloor::is_locked(Eigen::Index line) const {
  return locked_every >= dense && !is_clean(line, locked_every);
}

LineFloor line_floor(const Spectrum& spectrum, Eigen::Index locked_every) {
  LineFloor result =
      floor_of(spectrum, [&](Eigen::Index line) { return is_clean(line, locked_every); });
  result.locked_every = locked_every;
  return result;
}

LineFloor line_floor(const Spectrum& spectrum, const std::vector<bool>& left_out) {
  return floor_of(spectrum,
                  [&](Eigen::Index line) { return !left_out[static_cast<std::size_t>(line)]; });
}

}  // namespace rvbench::analysis
