#include "analysis/shaft_speed.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "analysis/fft.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index padding = 8;  // points per line of a periodogram
constexpr Eigen::Index smallest_block = 64;
constexpr double floor_lines = 16;   // at least, on both sides of a line
constexpr double stands_out = 0.01;  // p of a line, over the whole search

[[noreturn]] void refuse(const std::string& why) {
  throw std::invalid_argument("shaft_speeds: " + why);
}

void check(const std::vector<Channel>& channels, const ShaftLines& lines, Eigen::Index block) {
  if (channels.empty()) refuse("no channel");
  if (lines.orders.empty()) refuse("no order");
  if (!(lines.turns_per_sample > 0)) refuse("turns_per_sample must be > 0");
  if (!(lines.within > 0 && lines.within < 0.5)) refuse("within must be in (0, 0.5)");
  for (const double order : lines.orders) {
    if (!(order > 0)) refuse("an order must be > 0");
    if (order * lines.turns_per_sample * (1 + lines.within) >= 0.5) {
      refuse("order " + std::to_string(order) + " lies beyond half the sample rate");
    }
  }
  if (block < smallest_block) refuse("a block needs 64 samples");
  for (const Channel& channel : channels) {
    if (channel.samples.size() != channels.front().samples.size()) refuse("unequal lengths");
  }
}

// Power over a fine axis of cycles per sample, of a block without its mean, under a Hann window.
Eigen::ArrayXd fine_power(const Eigen::Ref<const Eigen::VectorXd>& x) {
  const Eigen::Index n = x.size();
  Eigen::VectorXd padded = Eigen::VectorXd::Zero(padding * n);
  const double mean = x.mean();
  for (Eigen::Index i = 0; i < n; ++i) {
    const double window =
        0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(i) / double(n));
    padded[i] = window * (x[i] - mean);
  }
  return fft(padded).array().abs2();
}

// The periodograms of one block, around the lines that are sought.
class Block {
 public:
  Block(const std::vector<Channel>& channels, const ShaftLines& lines, Eigen::Index first,
        Eigen::Index size)
      : lines_(lines), size_(size) {
    for (const Channel& channel : channels) {
      const Eigen::ArrayXd power = fine_power(channel.samples.segment(first, size));
      for (const double order : lines.orders) over_floor_.push_back(around(power, order));
    }
  }

  ShaftSpeed speed() const {
    const double highest = std::ranges::max(lines_.orders);
    const double step = 1 / (highest * static_cast<double>(padding * size_));
    const double from = lines_.turns_per_sample * (1 - lines_.within);
    const auto steps = static_cast<int>(2 * lines_.within * lines_.turns_per_sample / step);
    double best = from, most = -1;
    for (int i = 0; i <= steps; ++i) {
      const double f = from + i * step;
      if (const double score = summands(f).sum(); score > most) {
        best = f;
        most = score;
      }
    }
    ShaftSpeed found = at_peak(best, step);
    found.seen = seen(found.turns_per_sample, std::max(1.0, double(steps) / padding));
    if (2 * found.seen <= lines_.orders.size()) found = {not_known, not_known, found.seen};
    return found;
  }

 private:
  // Power over floor of one channel around one order, on the fine axis.
  struct Stretch {
    Eigen::Index first = 0;
    Eigen::ArrayXd ratio;
  };

  Stretch around(const Eigen::ArrayXd& power, double order) const {
    const double centre = order * lines_.turns_per_sample * static_cast<double>(padding * size_);
    const double half = std::max(2 * lines_.within * centre, floor_lines * double(padding));
    const auto last = static_cast<double>(power.size() - 1);
    const auto from = static_cast<Eigen::Index>(std::max(centre - half, 0.0));
    const auto to = static_cast<Eigen::Index>(std::min(centre + half, last));
    Stretch stretch{from, power.segment(from, to - from + 1)};
    // Noise power is exponentially distributed: its median is ln 2 of its mean.
    const double floor = median({stretch.ratio.begin(), stretch.ratio.end()}) / std::numbers::ln2;
    if (floor > 0) {
      stretch.ratio /= floor;
    } else {
      stretch.ratio.setZero();
    }
    return stretch;
  }

  // ln(1 + P/floor) of every line at a speed of f turns per sample, on parabolas between points.
  Eigen::VectorXd summands(double f) const {
    Eigen::VectorXd all(static_cast<Eigen::Index>(over_floor_.size()));
    for (std::size_t i = 0; i < over_floor_.size(); ++i) {
      const Stretch& stretch = over_floor_[i];
      const double at =
          f * lines_.orders[i % lines_.orders.size()] * static_cast<double>(padding * size_) -
          static_cast<double>(stretch.first);
      const auto k = std::clamp<Eigen::Index>(std::llround(at), 1, stretch.ratio.size() - 2);
      const double t = at - static_cast<double>(k);
      const double before = std::log1p(stretch.ratio[k - 1]), here = std::log1p(stretch.ratio[k]),
                   after = std::log1p(stretch.ratio[k + 1]);
      all[static_cast<Eigen::Index>(i)] =
          here + 0.5 * t * (after - before) + 0.5 * t * t * (after - 2 * here + before);
    }
    return all;
  }

  // @param f  a point of the peak's top, within a step of it
  ShaftSpeed at_peak(double f, double step) const {
    for (int i = 0; i < 2; ++i) {
      const double before = summands(f - step).sum(), here = summands(f).sum(),
                   after = summands(f + step).sum();
      const double bend = 2 * here - before - after;
      if (bend > 0) f += std::clamp(0.5 * (after - before) / bend, -1.0, 1.0) * step;
    }
    const Eigen::VectorXd before = summands(f - step), here = summands(f),
                          after = summands(f + step);
    const double slopes = (after - before).norm() / (2 * step);
    const double bend = std::abs((after - 2 * here + before).sum()) / (step * step);
    return {f, bend > 0 ? slopes / bend : not_known, 0};
  }

  // How many orders noise would not raise like this at any of so many speeds.
  std::size_t seen(double f, double speeds) const {
    const Eigen::ArrayXd ratios = summands(f).array().exp() - 1;
    const std::size_t orders = lines_.orders.size(), channels = over_floor_.size() / orders;
    std::size_t count = 0;
    for (std::size_t order = 0; order < orders; ++order) {
      double sum = 0, floors = 0;
      for (std::size_t c = 0; c < channels; ++c) {
        const std::size_t i = c * orders + order;
        sum += ratios[static_cast<Eigen::Index>(i)];
        floors += static_cast<double>(over_floor_[i].ratio.size()) / padding;
      }
      if (line_p_value(sum, double(channels), floors) * speeds < stands_out) ++count;
    }
    return count;
  }

  const ShaftLines& lines_;
  Eigen::Index size_;
  std::vector<Stretch> over_floor_;  // channel by channel, in order of the orders
};

}  // namespace

std::vector<ShaftSpeed> shaft_speeds(const std::vector<Channel>& channels, const ShaftLines& lines,
                                     Eigen::Index block) {
  check(channels, lines, block);
  std::vector<ShaftSpeed> speeds;
  const Eigen::Index size = channels.front().samples.size();
  for (Eigen::Index first = 0; first + block <= size; first += block / 2) {
    const bool whole = std::ranges::all_of(channels, [&](const Channel& channel) {
      return channel.samples.segment(first, block).allFinite();
    });
    speeds.push_back(whole ? Block(channels, lines, first, block).speed() : ShaftSpeed());
  }
  return speeds;
}

}  // namespace rvbench::analysis
