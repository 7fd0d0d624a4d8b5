#include "sim/steady_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <set>

#include "hal/types/linear_algebra.hpp"
#include "hal/types/units.hpp"
#include "sim/order_lines.hpp"

namespace rvbench::sim {
namespace {

using Complex = std::complex<double>;
using hal::ConfigFault;
using units::two_pi;

constexpr std::array mean_angles{7, 11, 13, 17};  // of the period: one of these numbers
constexpr double much_faster = 8;
constexpr double slope_step_rad = 1e-7;
constexpr double slope_step_of_speed = 1e-6;
constexpr double slopes_known_to = 1e-6;  // of the largest
constexpr double slowest_rad_s = 1e-3;    // of the fastest body: what counts as turning
constexpr double fastest_rad_s = 1e4;
constexpr int speeds_tried = 400;
constexpr int halvings = 60;
constexpr int most_rounds = 30;
constexpr std::size_t steps_mixed = 5;
constexpr double negligible_line = 1e-12;  // of the largest: not solved for

// From near it is differences between plants that count: what is left open must not show in them.
constexpr SteadyMotion::Rest from_nowhere{1, 1e-5, 1e-7};
constexpr SteadyMotion::Rest from_near{3, 1e-7, 1e-7};

double largest(const Eigen::MatrixXcd& lines) {
  return lines.size() > 0 ? std::sqrt(lines.cwiseAbs2().maxCoeff()) : 0;
}

// What comes a multiple of that many times would look like a mean slope: what goes round with the
// input shaft of a reducer of 121 comes a multiple of 11 times. The pushes' own orders count, not
// those that are solved: a wave above these is felt as well.
int choose_mean_angles(const PlantModel& model, const Eigen::VectorXd& common) {
  std::set<int> pushes;
  for (const auto& term : model.terms) term->add_orders(common, pushes);
  return *std::ranges::min_element(mean_angles, {}, [&](int count) {
    return std::ranges::count_if(pushes, [&](int order) { return order % count == 0; });
  });
}

// Up to which order all bodies swing slowly beside what the next faster body brings; 0: none does.
int find_slow_orders(const Eigen::VectorXd& common) {
  double next = std::numeric_limits<double>::infinity();
  for (const double turns : common.cwiseAbs()) {
    if (turns > 1) next = std::min(next, turns);
  }
  return std::isinf(next) ? 0 : static_cast<int>(next / much_faster);
}

}  // namespace

SteadyMotion::SteadyMotion(const PlantModel& model, Eigen::VectorXd common,
                           const Eigen::VectorXd& inputs, const PeriodOrders& orders)
    : model_(model),
      common_(std::move(common)),
      n_(model.inertia.size()),
      orders_(orders),
      count_(static_cast<Eigen::Index>(orders_.orders().size())),
      u_(si_inputs(model, inputs)),
      rhythms_(model, {Eigen::VectorXd::Zero(n_), Eigen::VectorXd::Zero(n_), {}, u_, 0}, common_),
      mean_angles_(choose_mean_angles(model, common_)),
      slow_orders_(find_slow_orders(common_)),
      linear_(linear_parts(model)),
      lines_(Eigen::MatrixXcd::Zero(n_, count_ + 1)) {
  for (const auto& term : model.terms) {
    if (rhythms_.is_one(term.get())) continue;
    steady_.push_back(term.get());
    if (!term->is_linear()) curved_.push_back(term.get());
  }
}

double SteadyMotion::omega_rad_s(Eigen::Index line) const {
  return line == 0 ? 0 : orders_.orders()[std::size_t(line - 1)] * std::abs(speed_rad_s_);
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
  rhythms_.set_clocks(s, t_s);
  return s;
}

void SteadyMotion::add_forces(PlantState& s, bool remainder_only, Eigen::VectorXd& f) const {
  rhythms_.mean_forces(s, remainder_only, f);
  for (const PhysicsTerm* term : remainder_only ? curved_ : steady_) {
    remainder_only ? term->add_remainder(s, f) : term->add_force(s, f);
  }
  for (std::size_t i = 0; i < model_.pushed.size(); ++i) {
    if (model_.pushed[i] >= 0) f[model_.pushed[i]] += u_[static_cast<Eigen::Index>(i)];
  }
}

// Without the slow swings of all bodies together: lines are those over the angle, at which gears
// meet. By time, what swings the speed would give them sidebands.
Eigen::MatrixXcd SteadyMotion::without_slow_swing() const {
  Eigen::MatrixXcd lines = lines_;
  const auto slow =
      std::ranges::count_if(orders_.orders(), [&](int k) { return k <= slow_orders_; });
  const Eigen::VectorXcd all_together = common_.normalized().cast<Complex>();
  auto swing = lines.middleCols(1, slow);
  swing -= all_together * (all_together.transpose() * swing).eval();
  return lines;
}

void SteadyMotion::go_round(const std::function<void(Eigen::Index, PlantState&)>& see) const {
  const Signals ways = over_period(without_slow_swing(), orders_);
  const Signals speeds = over_period(differentiated(lines_), orders_);
  const double step_rad = (speed_rad_s_ > 0 ? two_pi : -two_pi) / static_cast<double>(samples());
  PlantState s = mean_state(0);
  for (Eigen::Index i = 0; i < samples(); ++i) {
    s.q = common_ * (step_rad * static_cast<double>(i)) + ways.col(i);
    s.v = common_ * speed_rad_s_ + speeds.col(i);
    see(i, s);
  }
}

double SteadyMotion::drive_at(double speed_rad_s) {
  rhythms_.keep(speed_rad_s);
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
      rhythms_.keep(speed_rad_s_);
      return true;
    }
  }
  return false;
}

std::vector<double> SteadyMotion::mean_angles_rad() const {
  std::vector<double> angles_rad;
  for (int i = 0; i < mean_angles_; ++i) angles_rad.push_back(two_pi * (i + 0.5) / mean_angles_);
  return angles_rad;
}

// Mean slopes of the forces over the period: what the oscillation pulls at.
void SteadyMotion::find_slopes() {
  stiffness_ = damping_ = Eigen::MatrixXd::Zero(n_, n_);
  const double speed_step_rad_s = slope_step_of_speed * std::abs(speed_rad_s_);
  PlantState s = mean_state(0);
  const Eigen::VectorXd v = s.v;
  Eigen::VectorXd above(n_), below(n_);
  for (const double turned_rad : mean_angles_rad()) {
    const Eigen::VectorXd q = lines_.col(0).real() + common_ * turned_rad;
    const auto add_slope = [&](double& value, double step, auto column) {
      const double middle = value;
      value = middle + step;
      add_forces(s, false, above);
      value = middle - step;
      add_forces(s, false, below);
      value = middle;
      column -= (above - below) / (2 * step * mean_angles_);
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
  rhythms_.keep(speed_rad_s_);
  lines_.col(0).head(by_orders.rows()) = by_orders.col(0);
  for (Eigen::Index k = 1; k <= count_; ++k) {
    const int order = orders_.orders()[std::size_t(k - 1)];
    if (order < by_orders.cols()) lines_.col(k).head(by_orders.rows()) = by_orders.col(order);
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

// One round further: by a mixture of this step and those before.
void SteadyMotion::move(AndersonMixing& mixing, const Eigen::MatrixXcd& step,
                        double speed_step_rad_s) {
  const Eigen::Index size = step.size();
  Eigen::VectorXd all(2 * size + 1);
  all << step.real().reshaped(), step.imag().reshaped(), speed_step_rad_s;
  all = mixing.mixed(all);
  lines_.real() += all.head(size).reshaped(step.rows(), step.cols());
  lines_.imag() += all.segment(size, size).reshaped(step.rows(), step.cols());
  speed_rad_s_ += all[2 * size];
  rhythms_.keep(speed_rad_s_);
}

// Lines of the forces that the motion leaves open.
Eigen::MatrixXcd SteadyMotion::unbalanced(const Eigen::MatrixXcd& remainder) const {
  Eigen::MatrixXcd open =
      remainder - linear_.stiffness * lines_ - linear_.damping * differentiated(lines_);
  for (Eigen::Index k = 1; k <= count_; ++k) {
    open.col(k) += omega_rad_s(k) * omega_rad_s(k) *
                   model_.inertia.cast<Complex>().cwiseProduct(lines_.col(k));
  }
  return open;
}

bool SteadyMotion::come_to_rest(const Rest& rest) {
  AndersonMixing mixing(steps_mixed);
  const algebra::MinimumNorm held(stiffness_, slopes_known_to);
  Signals pushes(n_, samples());
  Eigen::VectorXd push(n_);
  // About the speed of the first round: that it is a little off costs a part of a round.
  std::vector<std::optional<algebra::ComplexLu>> answers(orders_.orders().size());
  for (int round = 0; round < most_rounds; ++round) {
    go_round([&](Eigen::Index i, PlantState& s) {
      add_forces(s, true, push);
      pushes.col(i) = push;
    });
    if (!pushes.allFinite()) return false;
    const Eigen::MatrixXcd remainder = lines_of(pushes, orders_);
    Eigen::VectorXd mean = remainder.col(0).real() - linear_.stiffness * lines_.col(0).real() -
                           linear_.damping * common_ * speed_rad_s_;
    const Eigen::MatrixXcd open = unbalanced(remainder);
    const double largest_push =
        std::max(pushes.cwiseAbs().maxCoeff(),
                 (linear_.damping * common_ * speed_rad_s_).cwiseAbs().maxCoeff());
    const bool at_rest = largest(open.rightCols(count_)) <=
                             std::max(rest.lines * largest(remainder.rightCols(count_)),
                                      negligible_line * largest_push) &&
                         mean.cwiseAbs().maxCoeff() <= rest.balance * largest_push;
    Eigen::MatrixXcd step = Eigen::MatrixXcd::Zero(n_, count_ + 1);
    step.col(0) = held.solve(mean).cast<Complex>();
    for (Eigen::Index k = 1; k <= count_; ++k) {
      if (open.col(k).squaredNorm() < std::pow(negligible_line * largest_push, 2)) continue;
      auto& answer = answers[static_cast<std::size_t>(k - 1)];
      if (!answer) answer.emplace(impedance(omega_rad_s(k)));
      step.col(k) = answer->solve(Eigen::VectorXcd(open.col(k)));
    }
    move(mixing, step, common_.dot(mean) / common_.dot(damping_ * common_));
    if (at_rest && round + 1 >= rest.rounds) return true;
  }
  return false;
}

}  // namespace rvbench::sim
