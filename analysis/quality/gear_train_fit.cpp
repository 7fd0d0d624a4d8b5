#include "analysis/quality/gear_train_fit.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/evidence/record_resolution.hpp"
#include "analysis/order/resolution.hpp"

namespace rvbench::analysis {
namespace {

constexpr int most_harmonics = 12;
constexpr double same_line = 0.6;                                 // of the resolution
constexpr double nearest = 1e-3, furthest = 0.05, step = 2.5e-4;  // relative, of other speeds
constexpr double stands_out = 1.5;     // a share, over that at any other speed
constexpr double worth_a_hint = 0.25;  // of the lines' power

double distance_to_multiple(double order, double of) {
  return std::abs(order - std::round(order / of) * of);
}

bool slips(double order, const Kinematics& kinematics) {
  return std::ranges::any_of(kinematics.signatures, [&](const Signature& s) {
    return s.slip > 0 && std::abs(order - s.order) <= s.slip * s.order;
  });
}

// Orders that this machine has, and not any that turns, in ascending order.
class OwnOrders {
 public:
  explicit OwnOrders(const Kinematics& kinematics) : period_turns_(kinematics.period_turns) {
    for (const CharacteristicOrder& o : kinematics.orders) {
      if (slips(o.order, kinematics)) continue;
      for (int h = 1; h <= most_harmonics; ++h) add(h * o.order, o.mesh);
      if (o.mesh) add_sidebands(o.order, kinematics);
    }
    std::ranges::sort(orders_);
  }

  bool empty() const { return orders_.empty(); }

  bool list(double order, double near) const {
    const auto from = std::ranges::lower_bound(orders_, order - near);
    return from != orders_.end() && *from <= order + near;
  }

  // Of those listed, or what repeats with the gear train, unless orders are so uncertain that half
  // of all lines do.
  bool explain(double order, double near) const {
    return list(order, near) || (period_turns_ > 1 && near * period_turns_ < 0.25 &&
                                 distance_to_multiple(order, 1 / period_turns_) <= near);
  }

 private:
  void add(double order, bool is_mesh) {
    constexpr double rounding = 1e-9;
    if (!is_mesh && distance_to_multiple(order, 1) < rounding) return;
    orders_.push_back(order);
  }

  // The first of each shaft: with more, one mesh's lines move onto those of the mesh whose wheel
  // has a tooth more.
  void add_sidebands(double mesh, const Kinematics& kinematics) {
    for (const CharacteristicOrder& side : kinematics.orders) {
      if (side.mesh || slips(side.order, kinematics)) continue;
      for (int h = 1; h <= most_harmonics; ++h) {
        add(h * mesh - side.order, false);
        add(h * mesh + side.order, false);
      }
    }
  }

  double period_turns_;
  std::vector<double> orders_;
};

// A line, and how far its order may be off.
struct Line {
  double order;
  double power;
  double near_lines;     // orders
  double near_relative;  // of its order
  double near(double at) const { return std::max(near_lines, near_relative * at); }
};

using ChannelLines = std::vector<Line>;

std::vector<ChannelLines> lines_of(const std::vector<Examination>& points,
                                   const Kinematics& kinematics, const OwnOrders& own) {
  std::vector<ChannelLines> channels;
  for (const Examination& point : points) {
    if (!(point.periods > 0)) continue;
    const double near_lines = same_line * record_resolution(point, kinematics);
    const double near_relative = speed_error(point.angle_measured);
    for (const ChannelExamination& channel : point.channels) {
      ChannelLines& lines = channels.emplace_back();
      for (const SpectralLine& l : channel.lines) {
        const Line line{l.order, l.amplitude * l.amplitude, near_lines, near_relative};
        const double near = line.near(l.order);
        const bool of_any_shaft = distance_to_multiple(l.order, 1) <= near;
        if (!of_any_shaft || own.list(l.order, near)) lines.push_back(line);
      }
      if (lines.empty()) channels.pop_back();
    }
  }
  return channels;
}

// With no line above the fifth of its channel, so that a few loud ones of another source do not
// decide, at whatever speed they are met.
std::vector<ChannelLines> evened(std::vector<ChannelLines> channels) {
  constexpr std::size_t loudest = 5;
  for (ChannelLines& lines : channels) {
    const std::size_t last = std::min(loudest, lines.size()) - 1;
    std::ranges::nth_element(lines, lines.begin() + std::ptrdiff_t(last), std::greater{},
                             &Line::power);
    const double cap = lines[last].power;
    for (Line& line : lines) line.power = std::min(line.power, cap);
  }
  return channels;
}

double share_at(double speed, const std::vector<ChannelLines>& channels, const OwnOrders& own) {
  double sum = 0;
  for (const ChannelLines& lines : channels) {
    double all = 0, fits = 0;
    for (const Line& line : lines) {
      const double order = line.order / speed;
      all += line.power;
      if (own.explain(order, line.near(order))) fits += line.power;
    }
    sum += fits / all;
  }
  return sum / static_cast<double>(channels.size());
}

struct Tried {
  double speed;
  double share;
};

// Speeds that are off, and what they explain.
std::vector<Tried> tried_speeds(const std::vector<ChannelLines>& channels, const OwnOrders& own) {
  std::vector<Tried> tried;
  const int first = static_cast<int>(std::lround(nearest / step));
  const int last = static_cast<int>(std::lround(furthest / step));
  for (int i = -last; i <= last; ++i) {
    const double speed = 1 + i * step;
    if (std::abs(i) >= first) tried.push_back({speed, share_at(speed, channels, own)});
  }
  return tried;
}

double share_as_good(double share, const std::vector<Tried>& tried) {
  const auto as_good =
      std::ranges::count_if(tried, [&](const Tried& t) { return t.share >= share; });
  return static_cast<double>(as_good) / static_cast<double>(tried.size());
}

void find_better_speed(const std::vector<Tried>& tried, GearTrainFit& fit) {
  const Tried best = *std::ranges::max_element(tried, {}, &Tried::share);
  if (best.share <= std::max(worth_a_hint, stands_out * fit.share)) return;
  double sum = 0;
  int equals = 0;
  for (const Tried& t : tried) {
    const bool is_near = std::abs(t.speed - best.speed) < 2 * nearest;
    if (!is_near && stands_out * t.share >= best.share) return;
    if (!is_near || t.share < best.share) continue;
    sum += t.speed;
    ++equals;
  }
  fit.best_speed = sum / equals;
  fit.best_share = best.share;
}

}  // namespace

bool has_own_lines(const Kinematics& kinematics) { return !OwnOrders(kinematics).empty(); }

GearTrainFit gear_train_fit(const std::vector<Examination>& points, const Kinematics& kinematics) {
  GearTrainFit fit;
  const OwnOrders own(kinematics);
  const std::vector<ChannelLines> channels = lines_of(points, kinematics, own);
  if (channels.empty()) return fit;
  fit.share = share_at(1, channels, own);
  const std::vector<Tried> tried = tried_speeds(channels, own);
  const std::vector<ChannelLines> even = evened(channels);
  fit.chance = std::min(share_as_good(fit.share, tried),
                        share_as_good(share_at(1, even, own), tried_speeds(even, own)));
  find_better_speed(tried, fit);
  return fit;
}

}  // namespace rvbench::analysis
