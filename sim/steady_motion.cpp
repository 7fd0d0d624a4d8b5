#include "sim/steady_motion.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>

#include "hal/types/units.hpp"
#include "sim/order_lines.hpp"
#include "sim/term_memory.hpp"

namespace rvbench::sim {
namespace {

using Complex = std::complex<double>;
using hal::ConfigFault;
using units::two_pi;

constexpr double held_together = 1e-9;    // of the stiffest way: below it bodies move freely
constexpr double whole = 1e-6;            // of a turn
constexpr double samples_per_line = 2.4;  // at least: more than the lines need, against aliasing
constexpr double fewest_samples = 64;
constexpr int slopes_at = 16;  // angles of the period that the mean slopes come from
constexpr double slope_step_rad = 1e-7;
constexpr double slope_step_of_speed = 1e-6;
constexpr double slopes_known_to = 1e-6;  // of the largest
constexpr double slowest_rad_s = 1e-3;    // of the fastest body: what counts as turning
constexpr double fastest_rad_s = 1e4;
constexpr int speeds_tried = 400;
constexpr int halvings = 60;
constexpr double rounding = 1e-6;
constexpr int most_rounds = 20;
constexpr double negligible_line = 1e-12;  // of the largest: not solved for

// From near, always as many rounds: what is left open then is a smooth function of the plant.
constexpr SteadyMotion::Rest from_nowhere{1, 1e-5, 1e-7};
constexpr SteadyMotion::Rest from_near{3, 1e-4, 1e-4};

// A power of two, or one and a half: quick to transform. What the terms push beyond the lines must
// not be taken for one of them.
Eigen::Index samples_for(int lines, int highest) {
  const double wanted =
      std::max({samples_per_line * lines, double(lines) + highest + 1, fewest_samples});
  const Eigen::Index power = Eigen::Index{1} << static_cast<int>(std::ceil(std::log2(wanted)));
  return 0.75 * static_cast<double>(power) >= wanted ? power / 4 * 3 : power;
}

// How often all of it comes again while the bodies make these turns; as often as the highest order
// if nothing knows where they are.
int repeats_of(const PlantModel& model, const Eigen::VectorXd& turns, int orders) {
  int all = 0;
  for (const auto& term : model.terms) all = std::gcd(all, term->repeats_in(turns));
  return all > 0 ? all : std::max(orders, 1);
}

int highest_of(const PlantModel& model, const Eigen::VectorXd& turns) {
  int highest = 0;
  for (const auto& term : model.terms) highest = std::max(highest, term->highest_in(turns));
  return highest;
}

// Calls what follows time twice, half a period apart: its own line cancels.
constexpr std::array<double, 2> half_periods{0, 0.5};

}  // namespace

std::variant<Eigen::VectorXd, ConfigFault> common_motion(const PlantModel& model) {
  const Eigen::Index n = model.inertia.size();
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd damping = stiffness;
  for (const auto& term : model.terms) term->add_linear(stiffness, damping);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(stiffness, Eigen::ComputeFullV);
  const Eigen::VectorXd& held = svd.singularValues();
  const Eigen::Index free = (held.array() <= held_together * held[0]).count();
  if (free != 1) {
    return ConfigFault{0, "/bodies",
                       fmt::format("{} bodies that can turn by themselves, not 1", free)};
  }
  Eigen::VectorXd common = svd.matrixV().col(n - 1);
  const double turning = held_together * common.cwiseAbs().maxCoeff();
  double slowest = std::numeric_limits<double>::infinity();
  for (double& turns : common) {
    if (std::abs(turns) <= turning) turns = 0;
    if (turns != 0 && std::abs(turns) < std::abs(slowest)) slowest = turns;
  }
  common /= slowest;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (std::abs(common[i] - std::round(common[i])) > whole * std::abs(common[i])) {
      return ConfigFault{
          0, fmt::format("/bodies/{}", i),
          fmt::format("makes {:.9g} turns for each of the slowest body's: no period", common[i])};
    }
    common[i] = std::round(common[i]);
  }
  return common;
}

const PhysicsTerm* held_by(const PlantModel& model, const Eigen::VectorXd& turns) {
  PlantState here{Eigen::VectorXd::LinSpaced(turns.size(), 0.1, 0.2), turns,
                  Eigen::VectorXd::Zero(model.memory_size),
                  Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.pushed.size())), 0};
  PlantState there = here;
  there.q += two_pi * turns;
  for (const auto& term : model.terms) {
    Eigen::VectorXd before = Eigen::VectorXd::Zero(turns.size()), after = before;
    term->add_force(here, before);
    term->add_force(there, after);
    if ((after - before).norm() > rounding * before.norm()) return term.get();
  }
  return nullptr;
}

SteadyMotion::SteadyMotion(const PlantModel& model, Eigen::VectorXd common,
                           const Eigen::VectorXd& inputs, int orders)
    : model_(model),
      common_(std::move(common)),
      n_(model.inertia.size()),
      repeats_(repeats_of(model, common_, orders)),
      count_(std::max(orders / repeats_, 1)),
      samples_(samples_for(count_, highest_of(model, common_) / repeats_)),
      u_(static_cast<Eigen::Index>(model.pushed.size())),
      clock_rates_(Eigen::VectorXd::Zero(model.memory_size)),
      linear_stiffness_(Eigen::MatrixXd::Zero(n_, n_)),
      linear_damping_(Eigen::MatrixXd::Zero(n_, n_)),
      lines_(Eigen::MatrixXcd::Zero(n_, count_ + 1)) {
  for (Eigen::Index i = 0; i < u_.size(); ++i) {
    const SignalTap& tap = model.taps[static_cast<std::size_t>(i)];
    u_[i] = tap.gain * inputs[tap.column] + tap.offset;
  }
  for (const auto& term : model.terms) term->add_linear(linear_stiffness_, linear_damping_);
  const PlantState still = mean_state(0);
  for (const auto& term : model.terms) {
    const double rhythm_Hz = term->rhythm_Hz(still);
    if (rhythm_Hz != 0) {
      rhythmic_.emplace_back(term.get(), rhythm_Hz);
    } else {
      steady_.push_back(term.get());
      if (!term->is_linear()) curved_.push_back(term.get());
    }
    const auto* memory = dynamic_cast<const TermMemory*>(term.get());
    if (memory != nullptr) memory->add_rates(still, clock_rates_);
  }
}

double SteadyMotion::omega_rad_s(Eigen::Index line) const {
  return static_cast<double>(line * repeats_) * std::abs(speed_rad_s_);
}

Eigen::MatrixXcd SteadyMotion::differentiated(const Eigen::MatrixXcd& lines) const {
  Eigen::MatrixXcd rate = lines;
  for (Eigen::Index k = 0; k < rate.cols(); ++k) rate.col(k) *= Complex(0, omega_rad_s(k));
  return rate;
}

Eigen::MatrixXcd SteadyMotion::impedance(double omega_rad_s) const {
  Eigen::MatrixXcd z = stiffness_.cast<Complex>();
  z += Complex(0, omega_rad_s) * damping_;
  z.diagonal() -= (omega_rad_s * omega_rad_s * model_.inertia).cast<Complex>();
  return z;
}

PlantState SteadyMotion::mean_state(double t_s) const {
  PlantState s{lines_.col(0).real(), common_ * speed_rad_s_, Eigen::VectorXd::Zero(0), u_, 0};
  set_clocks(s, t_s);
  return s;
}

void SteadyMotion::set_clocks(PlantState& s, double t_s) const {
  s.t_s = t_s;
  s.z = clock_rates_ * t_s;
}

void SteadyMotion::add_forces(PlantState& s, bool remainder_only, Eigen::VectorXd& f) const {
  const auto add = [&](const PhysicsTerm& term) {
    remainder_only ? term.add_remainder(s, f) : term.add_force(s, f);
  };
  f.setZero();
  for (const auto& [term, rhythm_Hz] : rhythmic_) {
    for (const double half : half_periods) {
      set_clocks(s, half / rhythm_Hz);
      add(*term);
    }
  }
  if (!rhythmic_.empty()) set_clocks(s, 0);
  f *= 0.5;
  for (const PhysicsTerm* term : remainder_only ? curved_ : steady_) add(*term);
  for (std::size_t i = 0; i < model_.pushed.size(); ++i) {
    if (model_.pushed[i] >= 0) f[model_.pushed[i]] += u_[static_cast<Eigen::Index>(i)];
  }
}

void SteadyMotion::go_round(const std::function<void(Eigen::Index, PlantState&)>& see) const {
  const Signals ways = over_period(lines_, samples_);
  const Signals speeds = over_period(differentiated(lines_), samples_);
  const double step_rad =
      (speed_rad_s_ > 0 ? two_pi : -two_pi) / static_cast<double>(samples_ * repeats_);
  PlantState s = mean_state(0);
  for (Eigen::Index i = 0; i < samples_; ++i) {
    s.q = common_ * (step_rad * static_cast<double>(i)) + ways.col(i);
    s.v = common_ * speed_rad_s_ + speeds.col(i);
    see(i, s);
  }
}

double SteadyMotion::drive_at(double speed_rad_s) const {
  PlantState s = mean_state(0);
  s.v = common_ * speed_rad_s;
  Eigen::VectorXd f(n_);
  add_forces(s, false, f);
  return common_.dot(f);
}

// The fastest speed that holds itself, forward if there is one: below it the drive wins, above it
// the brake.
bool SteadyMotion::find_speed() {
  const double ratio = common_.cwiseAbs().maxCoeff();
  const double factor = std::pow(fastest_rad_s / slowest_rad_s, 1.0 / speeds_tried);
  for (const double way : {1.0, -1.0}) {
    for (double high = fastest_rad_s / ratio; high * ratio > slowest_rad_s; high /= factor) {
      double fast = way * high, slow = fast / factor;
      if (way * drive_at(fast) >= 0 || way * drive_at(slow) < 0) continue;
      for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (fast + slow);
        (way * drive_at(middle) < 0 ? fast : slow) = middle;
      }
      speed_rad_s_ = 0.5 * (fast + slow);
      return true;
    }
  }
  return false;
}

// Mean slopes of the forces over the period: what the oscillation pulls at.
void SteadyMotion::find_slopes() {
  stiffness_ = damping_ = Eigen::MatrixXd::Zero(n_, n_);
  const double speed_step_rad_s = slope_step_of_speed * std::abs(speed_rad_s_);
  PlantState s = mean_state(0);
  const Eigen::VectorXd v = s.v;
  Eigen::VectorXd above(n_), below(n_);
  for (int angle = 0; angle < slopes_at; ++angle) {
    const double turned_rad = two_pi * (angle + 0.5) / slopes_at / repeats_;
    const Eigen::VectorXd q = lines_.col(0).real() + common_ * turned_rad;
    const auto add_slope = [&](double& value, double step, auto column) {
      const double middle = value;
      value = middle + step;
      add_forces(s, false, above);
      value = middle - step;
      add_forces(s, false, below);
      value = middle;
      column -= (above - below) / (2 * step * slopes_at);
    };
    s.q = q;
    s.v = v;
    for (Eigen::Index i = 0; i < n_; ++i) {
      add_slope(s.q[i], slope_step_rad, stiffness_.col(i));
      add_slope(s.v[i], speed_step_rad_s, damping_.col(i));
    }
  }
}

std::optional<ConfigFault> SteadyMotion::solve() {
  lines_.setZero();
  if (!find_speed()) return ConfigFault{0, "/inputs", "nothing keeps the bodies turning"};
  find_slopes();
  if (come_to_rest(from_nowhere)) return std::nullopt;
  return ConfigFault{0, "/terms", "the oscillation of the turning bodies does not come to rest"};
}

bool SteadyMotion::solve_near(double speed_rad_s, const Eigen::MatrixXcd& by_orders) {
  if (by_orders.rows() > n_) return false;
  speed_rad_s_ = speed_rad_s;
  for (Eigen::Index k = 0; k <= count_ && k * repeats_ < by_orders.cols(); ++k) {
    lines_.col(k).head(by_orders.rows()) = by_orders.col(k * repeats_);
  }
  for (Eigen::Index body = by_orders.rows(); body < n_; ++body) {
    // A body that was cut off another one goes with what turns as often.
    for (Eigen::Index like = 0; like < by_orders.rows(); ++like) {
      if (common_[like] == common_[body]) lines_.row(body) = lines_.row(like);
    }
  }
  find_slopes();
  return come_to_rest(from_near);
}

bool SteadyMotion::come_to_rest(const Rest& rest) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> held;
  held.setThreshold(slopes_known_to);
  held.compute(stiffness_);
  Signals pushes(n_, samples_);
  Eigen::VectorXd push(n_);
  for (int round = 0; round < most_rounds; ++round) {
    go_round([&](Eigen::Index i, PlantState& s) {
      add_forces(s, true, push);
      pushes.col(i) = push;
    });
    if (!pushes.allFinite()) return false;
    const Eigen::MatrixXcd remainder = lines_of(pushes, count_);
    Eigen::VectorXd mean = remainder.col(0).real() - linear_stiffness_ * lines_.col(0).real() -
                           linear_damping_ * common_ * speed_rad_s_;
    Eigen::MatrixXcd open =
        remainder - linear_stiffness_ * lines_ - linear_damping_ * differentiated(lines_);
    for (Eigen::Index k = 1; k <= count_; ++k) {
      open.col(k) += omega_rad_s(k) * omega_rad_s(k) *
                     model_.inertia.cast<Complex>().cwiseProduct(lines_.col(k));
    }
    const double largest =
        std::max(pushes.cwiseAbs().maxCoeff(),
                 (linear_damping_ * common_ * speed_rad_s_).cwiseAbs().maxCoeff());
    const double line = std::sqrt(remainder.rightCols(count_).cwiseAbs2().maxCoeff());
    const double open_line = std::sqrt(open.rightCols(count_).cwiseAbs2().maxCoeff());
    const bool at_rest = open_line <= std::max(rest.lines * line, negligible_line * largest) &&
                         mean.cwiseAbs().maxCoeff() <= rest.balance * largest;
    speed_rad_s_ += common_.dot(mean) / common_.dot(damping_ * common_);
    lines_.col(0) += held.solve(mean).cast<Complex>();
    for (Eigen::Index k = 1; k <= count_; ++k) {
      if (open.col(k).squaredNorm() < std::pow(negligible_line * largest, 2)) continue;
      lines_.col(k) += impedance(omega_rad_s(k)).partialPivLu().solve(open.col(k));
    }
    if (at_rest && round + 1 >= rest.rounds) return true;
  }
  return false;
}

}  // namespace rvbench::sim
