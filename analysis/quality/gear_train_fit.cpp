#include "analysis/quality/gear_train_fit.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <utility>

#include "analysis/evidence/record_resolution.hpp"
#include "analysis/order/resolution.hpp"
#include "analysis/spectral_lines.hpp"

namespace rvbench::analysis {
namespace {

constexpr int most_harmonics = 12;
constexpr double nearest = 1e-3, furthest = 0.05;  // relative, of other speeds, at the least
constexpr double too_far = 0.1;                    // the nearest, of a record that is too short
constexpr int tries_each_way = 197;
constexpr double hint_step = 2.5e-4;
constexpr double stands_out = 1.5;  // a share, over that at any other speed
constexpr double ratios[] = {1.5, 2, 3, 4, 5, 10};
constexpr double worth_a_hint = 0.25;  // of the lines' power

double distance_to_multiple(double order, double of) {
  return std::abs(order - std::round(order / of) * of);
}

// Orders that this machine has, and not any that turns, in ascending order. Not all that repeats
// with the gear train: so close a comb lies on itself again at speeds that are a little off.
class OwnOrders {
 public:
  explicit OwnOrders(const Kinematics& kinematics) {
    for (const CharacteristicOrder& o : kinematics.orders) {
      if (slips(o.order, kinematics)) continue;
      for (int h = 1; h <= most_harmonics; ++h) add(h * o.order, o.mesh);
      if (o.mesh) add_sidebands(o.order, kinematics);
    }
    std::ranges::sort(orders_);
  }

  bool empty() const { return orders_.empty(); }

  bool hold(double order, double near) const {
    const auto from = std::ranges::lower_bound(orders_, order - near);
    return from != orders_.end() && *from <= order + near;
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

  std::vector<double> orders_;
};

// A line, and how far its order may be off.
struct Line {
  double order;
  double power;
  double near;
};

using ChannelLines = std::vector<Line>;

// Whether a line is the input shaft's, as any machine has them: a whole order, unless it is a
// mesh's that stands out from the shaft's own harmonics to either side.
bool is_of_any_shaft(const SpectralLine& line, double near, const ChannelExamination& channel,
                     const OwnOrders& own) {
  if (distance_to_multiple(line.order, 1) > near) return false;
  if (!own.hold(line.order, near)) return true;
  constexpr double beside = 3;  // orders
  constexpr double loud = 2;
  return std::ranges::any_of(channel.lines, [&](const SpectralLine& other) {
    return std::abs(other.order - line.order) < beside + near && &other != &line &&
           distance_to_multiple(other.order, 1) <= near && !own.hold(other.order, near) &&
           loud * other.amplitude > line.amplitude;
  });
}

std::vector<ChannelLines> lines_of(const std::vector<Examination>& points,
                                   const Kinematics& kinematics, const OwnOrders& own) {
  std::vector<ChannelLines> channels;
  for (const Examination& point : points) {
    if (!(point.periods > 0)) continue;
    const double resolution = record_resolution(point, kinematics);
    for (const ChannelExamination& channel : point.channels) {
      ChannelLines& lines = channels.emplace_back();
      // Weaker ones are listed only where they lie on orders of the speed that was used.
      const std::size_t count = std::min(channel.lines.size(), most_lines);
      for (const SpectralLine& l : std::span(channel.lines).first(count)) {
        const double near = near_order(l.order, resolution, point.angle_measured);
        if (is_of_any_shaft(l, near, channel, own)) continue;
        lines.push_back({l.order, l.amplitude * l.amplitude, near});
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

// Each line as good as any.
std::vector<ChannelLines> counted(std::vector<ChannelLines> channels) {
  for (ChannelLines& lines : channels) {
    for (Line& line : lines) line.power = 1;
  }
  return channels;
}

// Share of the power of lines that fit at each of these speeds.
double share_at(std::initializer_list<double> speeds, const std::vector<ChannelLines>& channels,
                const OwnOrders& own) {
  double sum = 0;
  for (const ChannelLines& lines : channels) {
    double all = 0, fits = 0;
    for (const Line& line : lines) {
      all += line.power;
      const bool fits_all = std::ranges::all_of(
          speeds, [&](double speed) { return own.hold(line.order / speed, line.near / speed); });
      if (fits_all) fits += line.power;
    }
    sum += fits / all;
  }
  return sum / static_cast<double>(channels.size());
}

// How far another speed must be off so that the lines that fit at this one do no more: twice what
// their orders may be off. Relative.
double parted_from(double speed, const std::vector<ChannelLines>& channels, const OwnOrders& own) {
  double sum = 0, power = 0;
  for (const ChannelLines& lines : channels) {
    for (const Line& line : lines) {
      if (!own.hold(line.order / speed, line.near / speed)) continue;
      sum += line.power * 2 * line.near / line.order;
      power += line.power;
    }
  }
  return power > 0 ? std::max(sum / power, nearest) : nearest;
}

// What a speed explains, by the lines' power and with the loudest evened: of few loud lines alone
// many speeds explain as much.
struct Tried {
  double speed;
  double share;
  double even_share;
  double both() const { return share + even_share; }
};

class Trials {
 public:
  Trials(const std::vector<ChannelLines>& channels, const OwnOrders& own)
      : channels_(channels), even_(evened(channels)), counted_(counted(channels)), own_(own) {}

  Tried at(double speed) const {
    return {speed, share_at({speed}, channels_, own_), share_at({speed}, even_, own_)};
  }

  // At speeds that are off by `from` and more, evenly.
  std::vector<Tried> beyond(double from) const {
    std::vector<Tried> tried;
    const double to = std::max(furthest, 5 * from);
    for (int i = 0; i < tries_each_way; ++i) {
      const double off = from + (to - from) * i / (tries_each_way - 1);
      for (const double speed : {1 - off, 1 + off}) tried.push_back(at(speed));
    }
    return tried;
  }

  // The best speed that is off by a ratio and explains so much that this one need not be right. At
  // lower speeds the harmonics of a mesh lie on its higher ones. At higher ones most of them lie on
  // none: where nearly all that is explained is explained there as well, nothing speaks for this
  // one.
  std::optional<Tried> rival_ratio(const Tried& here) const {
    constexpr double nearly_all = 0.95;
    std::optional<Tried> best;
    const auto consider = [&](double speed, double least) {
      const Tried tried = at(speed);
      if (tried.share < worth_a_hint || tried.both() < least * here.both()) return;
      const auto of = [](const Tried& t) { return std::pair(t.both(), t.speed); };
      if (!best || of(tried) > of(*best)) best = tried;  // of equals the fastest
    };
    for (const double ratio : ratios) {
      consider(1 / ratio, stands_out);
      const double of_both =
          share_at({1, ratio}, channels_, own_) + share_at({1, ratio}, even_, own_);
      if (of_both >= nearly_all * here.both() && !has_lines_of_its_own(ratio)) {
        consider(ratio, nearly_all);
      }
    }
    return best;
  }

  // Whether more lines, however weak, speak for this speed and against the one that is off by the
  // ratio than at any other speed that is tried.
  bool has_lines_of_its_own(double ratio) const {
    const auto alone = [&](double speed) {
      return share_at({speed}, counted_, own_) - share_at({speed, speed * ratio}, counted_, own_);
    };
    const double here = alone(1);
    for (int i = 0; i < tries_each_way; ++i) {
      const double off = furthest * (i + 1) / tries_each_way;
      if (alone(1 - off) >= here || alone(1 + off) >= here) return false;
    }
    return true;
  }

  // Closer than those that are tried for chance: as far off as a rounded speed.
  void add_nearer(double than, std::vector<Tried>& tried) const {
    for (double off = 2 * stated_speed_error; off < than; off += hint_step) {
      for (const double speed : {1 - off, 1 + off}) tried.push_back(at(speed));
    }
  }

 private:
  const std::vector<ChannelLines>& channels_;
  std::vector<ChannelLines> even_;
  std::vector<ChannelLines> counted_;
  const OwnOrders& own_;
};

void find_better_speed(const std::vector<Tried>& tried, const std::vector<ChannelLines>& channels,
                       const OwnOrders& own, GearTrainFit& fit) {
  const Tried best = *std::ranges::max_element(tried, {}, &Tried::share);
  if (best.share <= std::max(worth_a_hint, stands_out * fit.share)) return;
  const double shoulder = std::max(2 * nearest, parted_from(best.speed, channels, own));
  double sum = 0;
  int equals = 0;
  for (const Tried& t : tried) {
    const bool is_near = std::abs(t.speed - best.speed) < shoulder;
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
  const Trials trials(channels, own);
  const Tried here = trials.at(1);
  fit.share = here.share;
  const double from = parted_from(1, channels, own);
  fit.is_too_short = from > too_far;
  if (fit.is_too_short) return fit;
  std::vector<Tried> tried = trials.beyond(from);
  fit.tried = static_cast<int>(tried.size());
  fit.as_good = static_cast<int>(
      std::ranges::count_if(tried, [&](const Tried& t) { return t.both() >= here.both(); }));
  trials.add_nearer(from, tried);
  find_better_speed(tried, channels, own, fit);
  // A measured angle leaves no such speed open.
  if (std::ranges::all_of(points, &Examination::angle_measured)) return fit;
  const auto ratio = trials.rival_ratio(here);
  if (!ratio || ratio->share <= fit.best_share) return fit;
  fit.fits_a_ratio = true;
  fit.best_speed = ratio->speed;
  fit.best_share = ratio->share;
  return fit;
}

}  // namespace rvbench::analysis
