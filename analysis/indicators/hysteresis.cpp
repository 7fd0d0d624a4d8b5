#include "analysis/indicators/hysteresis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "analysis/indicators/torsion_turns.hpp"
#include "analysis/smallest_step.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/recording.hpp"
#include "hal/types/require.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

using Signal = Eigen::Ref<const Eigen::VectorXd>;
using Branch = TorsionBranch;
using Turn = TorsionTurn;
using units::arcmin_from_rad;

constexpr double light_load = 0.03;  // of rated: where lost motion is taken
constexpr double half_load = 0.5;    // of rated: from here to rated torque a reducer is linear
constexpr Eigen::Index grid_points = 201;
constexpr double fewest_of_slope = 5;  // of the grid's points
constexpr Eigen::Index fewest_samples_of_branch = 50;
constexpr double least_common = 0.5;  // of a branch: the torsion that its partner spans as well
constexpr double tip_share = 0.01;    // of a loop at each end: where friction turns round
constexpr double end_share = 0.1;     // of a branch: where it must still rise
constexpr double slipping = 0.2;      // of the mean slope: at its end a branch is as good as flat
constexpr double most_open = 0.25;    // of the lost motion: how far a loop may fail to close
constexpr double steps_to_tell = 5;   // of the angle, in a lost motion
constexpr double interval_p = 0.05;

// Mean torsion and torque of the samples in each cell that has any, in rising order.
struct Curve {
  std::vector<double> torsion_rad, torque_Nm;

  double at(double rad) const {
    const auto next = std::ranges::lower_bound(torsion_rad, rad);
    if (next == torsion_rad.begin()) return torque_Nm.front();
    if (next == torsion_rad.end()) return torque_Nm.back();
    const auto i = static_cast<std::size_t>(next - torsion_rad.begin());
    const double part = (rad - torsion_rad[i - 1]) / (torsion_rad[i] - torsion_rad[i - 1]);
    return std::lerp(torque_Nm[i - 1], torque_Nm[i], part);
  }
};

Curve curve_of(const Signal& torque_Nm, const Signal& torsion_rad, double cell_rad) {
  const double least_rad = torsion_rad.minCoeff();
  const auto cells = static_cast<std::size_t>((torsion_rad.maxCoeff() - least_rad) / cell_rad) + 1;
  std::vector<double> rad(cells), Nm(cells), count(cells);
  for (Eigen::Index i = 0; i < torque_Nm.size(); ++i) {
    const auto cell = static_cast<std::size_t>((torsion_rad[i] - least_rad) / cell_rad);
    rad[cell] += torsion_rad[i];
    Nm[cell] += torque_Nm[i];
    count[cell] += 1;
  }
  Curve curve;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    if (count[cell] == 0) continue;
    curve.torsion_rad.push_back(rad[cell] / count[cell]);
    curve.torque_Nm.push_back(Nm[cell] / count[cell]);
  }
  return curve;
}

// Where a rising curve passes a level: the middle between its first and its last passage, for in a
// clearance without friction it lies on the level. @pre it passes
double passage(const HysteresisLoop& loop, const Eigen::VectorXd& curve_Nm, double level_Nm) {
  double first = not_known, last = not_known;
  for (Eigen::Index i = 1; i < curve_Nm.size(); ++i) {
    const double before = curve_Nm[i - 1] - level_Nm, after = curve_Nm[i] - level_Nm;
    if ((before < 0) == (after < 0)) continue;
    last = double(i - 1) + before / (before - after);
    if (std::isnan(first)) first = last;
  }
  return loop.first_rad + loop.step_rad * (first + last) / 2;
}

bool passes(const Eigen::VectorXd& curve_Nm, double level_Nm) {
  return curve_Nm.minCoeff() < level_Nm && curve_Nm.maxCoeff() >= level_Nm;
}

// Slope of what is passed on from half to full load in one direction. @pre it reaches full load
// @return empty where a clearance takes almost all of the grid
std::optional<double> slope(const HysteresisLoop& loop, const Eigen::VectorXd& passed_Nm,
                            double rated_Nm) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (Eigen::Index i = 0; i < passed_Nm.size(); ++i) {
    const double load = passed_Nm[i] / rated_Nm;
    if (load < half_load || load > 1) continue;
    const double at = double(i) * loop.step_rad;
    n += 1, x += at, y += passed_Nm[i], xx += at * at, xy += at * passed_Nm[i];
  }
  if (n < fewest_of_slope) return std::nullopt;
  return (n * xy - x * y) / (n * xx - x * x);
}

LoopMean mean_of(const std::vector<double>& values) {
  const Eigen::Map<const Eigen::VectorXd> x(values.data(), Eigen::Index(values.size()));
  const double n = double(values.size());
  if (values.size() < 2) return {x.mean(), not_known};
  const double deviation = std::sqrt((x.array() - x.mean()).square().sum() / (n - 1));
  return {x.mean(), t_of_p_value(interval_p, n - 1) * deviation / std::sqrt(n)};
}

// One record of a test, cut into branches.
class LoopTest {
 public:
  LoopTest(const Signal& torque_Nm, const Signal& torsion_rad, double rated_Nm)
      : torque_Nm_(torque_Nm), torsion_rad_(torsion_rad), rated_Nm_(rated_Nm) {}

  void run() {
    const auto turns = torsion_turns(torque_Nm_, torsion_rad_, light_load * rated_Nm_);
    if (turns.size() < 3) {
      result_.cannot_tell.push_back(
          fmt::format("the torque does not pass ±{:.3g} N·m, 3 % of the rated torque, to and fro",
                      light_load * rated_Nm_));
    }
    for (std::size_t k = 0; k + 2 < turns.size(); k += 2) {
      add_loop({turns[k], turns[k + 1]}, {turns[k + 1], turns[k + 2]});
    }
    if (!lost_motions_.empty()) conclude();
  }

  Hysteresis result() && { return std::move(result_); }

 private:
  double torsion_rad(const Turn& turn) const { return torsion_rad_[turn.at]; }
  double way_rad(const Branch& b) const { return torsion_rad(b.to) - torsion_rad(b.from); }

  // Whether the torque no longer rises where the branch ends: the output gives way.
  bool slips(const Branch& branch) const {
    const double end_rad = torsion_rad(branch.to);
    const double whole_rad = way_rad(branch);
    Eigen::Index i = branch.to.at;
    while (i > branch.from.at && (end_rad - torsion_rad_[i]) / whole_rad < end_share) --i;
    const double gained_Nm = branch.to.peak_Nm - torque_Nm_[i];
    const double mean_Nm =
        (branch.to.peak_Nm - branch.from.peak_Nm) / whole_rad * (end_rad - torsion_rad_[i]);
    return !(gained_Nm / mean_Nm > slipping);
  }

  // By how much the torsion misses where the loop began, where the torque is what it was.
  double opening_rad(const Branch& there, const Branch& back) const {
    const double way_Nm = there.to.peak_Nm - there.from.peak_Nm;
    const double ends_Nm = back.to.peak_Nm - there.from.peak_Nm;
    return std::abs(torsion_rad(back.to) - torsion_rad(there.from) -
                    ends_Nm * way_rad(there) / way_Nm);
  }

  std::string why_not(const Branch& there, const Branch& back) const {
    const auto fewest = std::min(there.size(), back.size());
    if (fewest < fewest_samples_of_branch) {
      return fmt::format("a branch of {} samples, {} are needed", fewest, fewest_samples_of_branch);
    }
    if (slips(there) || slips(back)) {
      return "the torque does not rise to the end of its way: the output slips";
    }
    const double common_rad = std::min(std::abs(way_rad(there)), std::abs(way_rad(back))) -
                              std::abs(torsion_rad(back.to) - torsion_rad(there.from));
    if (common_rad < least_common * std::abs(way_rad(there))) {
      return "its branches hardly span the same torsion: the output has turned";
    }
    return "";
  }

  HysteresisLoop loop_of(const Branch& there, const Branch& back) const {
    const bool rises = there.to.peak_Nm > there.from.peak_Nm;
    const Branch& up = rises ? there : back;
    const Branch& down = rises ? back : there;
    const auto part = [](const Signal& x, const Branch& b) {
      return x.segment(b.from.at, b.size());
    };
    const auto up_rad = part(torsion_rad_, up), down_rad = part(torsion_rad_, down);
    HysteresisLoop loop;
    const double least_rad = std::max(up_rad.minCoeff(), down_rad.minCoeff());
    const double most_rad = std::min(up_rad.maxCoeff(), down_rad.maxCoeff());
    loop.first_rad = std::lerp(least_rad, most_rad, tip_share);
    loop.step_rad = (1 - 2 * tip_share) * (most_rad - least_rad) / (grid_points - 1);
    const Curve rising = curve_of(part(torque_Nm_, up), up_rad, loop.step_rad);
    const Curve falling = curve_of(part(torque_Nm_, down), down_rad, loop.step_rad);
    loop.rising_Nm.resize(grid_points);
    loop.falling_Nm.resize(grid_points);
    for (Eigen::Index i = 0; i < grid_points; ++i) {
      const double at_rad = loop.first_rad + double(i) * loop.step_rad;
      loop.rising_Nm[i] = rising.at(at_rad);
      loop.falling_Nm[i] = falling.at(at_rad);
    }
    return loop;
  }

  void add_loop(const Branch& there, const Branch& back) {
    const int number = ++loops_;
    const auto refuse = [&](const std::string& why) {
      result_.cannot_tell.push_back(fmt::format("loop {}: {}", number, why));
    };
    if (const std::string why = why_not(there, back); !why.empty()) return refuse(why);
    HysteresisLoop loop = loop_of(there, back);
    const Eigen::VectorXd passed_Nm = loop.passed_Nm();
    const double light_Nm = light_load * rated_Nm_;
    if (!passes(passed_Nm, light_Nm) || !passes(passed_Nm, -light_Nm)) {
      return refuse("what is passed on does not reach ±3 % of the rated torque");
    }
    loop.minus_rad = passage(loop, passed_Nm, -light_Nm);
    loop.plus_rad = passage(loop, passed_Nm, light_Nm);
    const double lost_rad = loop.plus_rad - loop.minus_rad;
    const double open_rad = opening_rad(there, back);
    if (open_rad > most_open * lost_rad) {
      return refuse(fmt::format("it does not close by {:.3g} arcmin: the output has turned",
                                arcmin_from_rad(open_rad)));
    }
    lost_motions_.push_back(lost_rad);
    if (passes(loop.rising_Nm, 0) && passes(loop.falling_Nm, 0)) {
      widths_.push_back(passage(loop, loop.falling_Nm, 0) - passage(loop, loop.rising_Nm, 0));
    }
    reached_ =
        std::min({reached_, passed_Nm.maxCoeff() / rated_Nm_, -passed_Nm.minCoeff() / rated_Nm_});
    if (reached_ >= 1) {
      const std::optional<double> plus = slope(loop, passed_Nm, rated_Nm_);
      const std::optional<double> minus = slope(loop, passed_Nm, -rated_Nm_);
      if (plus && minus) stiffnesses_.push_back((*plus + *minus) / 2);
    }
    result_.loops.push_back(loop);
  }

  void conclude() {
    const LoopMean lost_rad = mean_of(lost_motions_);
    const double step_rad = smallest_step(torsion_rad_);
    if (lost_rad.value < steps_to_tell * step_rad) {
      result_.cannot_tell.push_back(fmt::format(
          "lost motion and hysteresis width: the angle is read in steps of {:.3g} arcmin at the "
          "output, too coarse for {:.3g} arcmin",
          arcmin_from_rad(step_rad), arcmin_from_rad(lost_rad.value)));
    } else {
      result_.lost_motion_rad = lost_rad;
      if (!widths_.empty()) result_.width_rad = mean_of(widths_);
    }
    if (stiffnesses_.size() == lost_motions_.size()) {
      result_.stiffness_Nm_per_rad = mean_of(stiffnesses_);
    } else if (reached_ >= 1) {
      result_.cannot_tell.push_back(fmt::format(
          "torsional stiffness: almost all of the way is clearance; less than {:.0f} of "
          "{} points of it lie between half and full rated torque",
          fewest_of_slope, grid_points));
    } else {
      result_.cannot_tell.push_back(
          fmt::format("torsional stiffness: what is passed on reaches {:.0f} % of the rated torque "
                      "in both directions, 100 % are needed",
                      std::floor(100 * reached_)));
    }
  }

  const Signal& torque_Nm_;
  const Signal& torsion_rad_;
  double rated_Nm_;
  Hysteresis result_;
  int loops_ = 0;
  double reached_ = 1e9;  // of the rated torque, in both directions and by every loop
  std::vector<double> lost_motions_, widths_, stiffnesses_;
};

}  // namespace

Hysteresis hysteresis(const Signal& torque_Nm, const Signal& torsion_rad, double rated_Nm) {
  constexpr Require require{"hysteresis"};
  require(torque_Nm.size() == torsion_rad.size(), "needs as many torques as torsions");
  require(torque_Nm.allFinite() && torsion_rad.allFinite(), "sample not finite");
  require(rated_Nm > 0, "rated_Nm must be above 0");
  LoopTest test(torque_Nm, torsion_rad, rated_Nm);
  test.run();
  return std::move(test).result();
}

}  // namespace rvbench::analysis
