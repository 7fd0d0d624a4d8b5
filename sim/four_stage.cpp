#include "sim/four_stage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "sim/linear_flow.hpp"

namespace rvbench::sim {
namespace {

constexpr double out_of_bounds = 1e9;

std::vector<const DryFriction*> dry_frictions(const PlantModel& model) {
  std::vector<const DryFriction*> dry;
  for (const auto& term : model.terms) {
    if (const auto* friction = dynamic_cast<const DryFriction*>(term.get()))
      dry.push_back(friction);
  }
  return dry;
}

std::vector<int> free_bodies(const PlantModel& model) {
  std::vector<int> free;
  for (int body = 0; body < model.inertia.size(); ++body) {
    if (std::find(model.prescribed.begin(), model.prescribed.end(), body) ==
        model.prescribed.end()) {
      free.push_back(body);
    }
  }
  return free;
}

struct Product {
  const Eigen::MatrixXd& m;
  const Eigen::VectorXd& x;
};

template <int rows, bool adds>
void sum_columns(std::initializer_list<Product> products, double* y) {
  std::array<double, rows> sum{};
  if constexpr (adds) std::copy_n(y, rows, sum.begin());
  for (const auto& [m, x] : products) {
    const double* column = m.data();
    const double* const factors = x.data();
    for (Eigen::Index j = 0; j < m.cols(); ++j, column += rows) {
      for (std::size_t i = 0; i < rows; ++i) sum[i] += column[i] * factors[j];
    }
  }
  std::copy_n(sum.begin(), rows, y);
}

// Sums into the first elements of y, as many as the matrices have rows. Plants are small: a plain
// loop beats what a library must find out first, and one whose length is known the loop that must
// count.
template <bool adds>
void sum_products(std::initializer_list<Product> products, Eigen::VectorXd& y) {
  double* const out = y.data();
  const Eigen::Index rows = products.begin()->m.rows();
  switch (rows) {
    case 1: return sum_columns<1, adds>(products, out);
    case 2: return sum_columns<2, adds>(products, out);
    case 3: return sum_columns<3, adds>(products, out);
    case 4: return sum_columns<4, adds>(products, out);
    default: break;
  }
  if constexpr (!adds) std::fill_n(out, rows, 0.0);
  for (const auto& [m, x] : products) {
    const double* column = m.data();
    for (Eigen::Index j = 0; j < m.cols(); ++j, column += rows) {
      const double factor = x.data()[j];
      for (Eigen::Index i = 0; i < rows; ++i) out[i] += column[i] * factor;
    }
  }
}

// y = sum of m·x
void set_sum(std::initializer_list<Product> products, Eigen::VectorXd& y) {
  sum_products<false>(products, y);
}

// y += m·x
void add_product(const Eigen::MatrixXd& m, const Eigen::VectorXd& x, Eigen::VectorXd& y) {
  sum_products<true>({{m, x}}, y);
}

}  // namespace

FourStage::FourStage(const PlantModel& model, double step_s)
    : model_(model),
      step_s_(step_s),
      free_(free_bodies(model)),
      contacts_(dry_frictions(model), free_),
      accelerations_(model.prescribed.size()) {
  for (const auto& term : model.terms) {
    const bool dry = dynamic_cast<const DryFriction*>(term.get()) != nullptr;
    if (!term->is_linear() && !dry) smooth_.push_back(term.get());
    if (const auto* memory = dynamic_cast<const TermMemory*>(term.get())) {
      memories_.push_back(memory);
    }
  }
  const Eigen::Index bodies = model.inertia.size();
  state_.q = model.start_position;
  state_.v = model.start_speed;
  state_.z = Eigen::VectorXd::Zero(model.memory_size);
  state_.u = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.pushed.size()));
  forces_ = Eigen::VectorXd::Zero(bodies);
  split_linear_part();
}

void FourStage::split_linear_part() {
  const auto [stiffness, damping] = linear_parts(model_);
  const auto n = static_cast<Eigen::Index>(free_.size());
  const auto given = static_cast<Eigen::Index>(model_.prescribed.size());
  const Eigen::Index m = model_.memory_size;
  coupling_.resize(n, 2 * given);
  coupling_.leftCols(given) = -stiffness(free_, model_.prescribed);
  coupling_.rightCols(given) = -damping(free_, model_.prescribed);
  given_ = Eigen::VectorXd::Zero(2 * given);

  const Eigen::VectorXd inertia = model_.inertia(free_);
  const LinearBodies linear(inertia, stiffness(free_, free_), damping(free_, free_));
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n + m, 2 * n + m);
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(2 * n + m, n + m);
  a.topLeftCorner(2 * n, 2 * n) = linear.a;
  b.topLeftCorner(2 * n, n) = linear.b;
  b.bottomRightCorner(m, m).setIdentity();
  LinearFlow half(a, b, step_s_ / 2);
  const LinearFlow whole(a, b, step_s_);
  phi_half_ = std::move(half.phi);
  gamma_half_ = std::move(half.gamma0);
  phi_ = whole.phi;
  first_ = whole.gamma0 - 3 * whole.gamma1 + 4 * whole.gamma2;
  middle_ = 2 * whole.gamma1 - 4 * whole.gamma2;
  last_ = 4 * whole.gamma2 - whole.gamma1;
  contacts_.set_step(whole.gamma0);

  x_ = stage_ = at_half_ = next_ = Eigen::VectorXd::Zero(2 * n + m);
  r0_ = ra_ = rb_ = rc_ = Eigen::VectorXd::Zero(n + m);
}

void FourStage::set_signals(const double* si, double t_s) {
  state_.t_s = t_s;
  for (Eigen::Index i = 0; i < state_.u.size(); ++i) state_.u[i] = *si++;
  for (std::size_t i = 0; i < model_.prescribed.size(); ++i) {
    const int body = model_.prescribed[i];
    state_.q[body] = given_[static_cast<Eigen::Index>(i)] = *si++;
    state_.v[body] = given_[given_.size() / 2 + static_cast<Eigen::Index>(i)] = *si++;
    accelerations_[i] = *si++;
  }
}

void FourStage::set_state(const Eigen::VectorXd& x) {
  const auto n = static_cast<Eigen::Index>(free_.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    const int body = free_[static_cast<std::size_t>(i)];
    state_.q[body] = x[i];
    state_.v[body] = x[n + i];
  }
  for (Eigen::Index i = 0; i < state_.z.size(); ++i) state_.z[i] = x[2 * n + i];
}

void FourStage::remainder(Eigen::VectorXd& r) {
  double* const f = forces_.data();
  std::fill_n(f, forces_.size(), 0.0);
  for (std::size_t i = 0; i < model_.pushed.size(); ++i) {
    if (model_.pushed[i] >= 0) f[model_.pushed[i]] += state_.u.data()[i];
  }
  for (const PhysicsTerm* term : smooth_) term->add_remainder(state_, forces_);
  for (std::size_t i = 0; i < free_.size(); ++i) r.data()[i] = f[free_[i]];
  if (!contacts_.empty()) contacts_.add_foreseen(r);
  if (!memories_.empty()) {
    r.tail(state_.z.size()).setZero();
    for (const TermMemory* memory : memories_) memory->add_rates(state_, r.tail(state_.z.size()));
  }
  if (given_.size() > 0) add_product(coupling_, given_, r);
}

void FourStage::start(const double* si) {
  const auto n = static_cast<Eigen::Index>(free_.size());
  steps_ = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const int body = free_[static_cast<std::size_t>(i)];
    x_[i] = model_.start_position[body];
    x_[n + i] = model_.start_speed[body];
  }
  x_.tail(state_.z.size()).setZero();
  set_state(x_);
  set_signals(si, 0);
  contacts_.start(state_);
}

void FourStage::step(const double* si0, const double* si1, const double* si2) {
  const double t_s = static_cast<double>(steps_) * step_s_;
  ++steps_;
  const double end_s = static_cast<double>(steps_) * step_s_;
  if (x_.size() == 0) return set_signals(si2, end_s);

  set_signals(si0, t_s);
  contacts_.read_limits(state_);
  remainder(r0_);
  set_signals(si1, 0.5 * (t_s + end_s));
  if (smooth_.empty() && memories_.empty()) {  // then the forces do not depend on the stages
    remainder(ra_);
    rb_ = ra_;
  } else {
    middle_stages();
  }
  set_signals(si2, end_s);
  remainder(rc_);
  rb_ += ra_;
  set_sum({{phi_, x_}, {first_, r0_}, {middle_, rb_}, {last_, rc_}}, next_);
  set_state(next_);
  if (!contacts_.empty()) {
    contacts_.correct(state_, next_);
    set_state(next_);
  }
  x_.swap(next_);
}

// Leaves the state in the last stage, and r at both stages of the middle.
void FourStage::middle_stages() {
  set_sum({{phi_half_, x_}}, at_half_);
  stage_ = at_half_;
  add_product(gamma_half_, r0_, stage_);
  set_state(stage_);
  remainder(ra_);
  add_product(gamma_half_, ra_, at_half_);
  set_state(at_half_);
  remainder(rb_);
  rc_ = 2 * rb_ - r0_;
  set_sum({{phi_half_, stage_}, {gamma_half_, rc_}}, at_half_);
  set_state(at_half_);
}

void FourStage::forces(Eigen::Ref<Eigen::VectorXd> f) const {
  f.setZero();
  for (std::size_t i = 0; i < model_.pushed.size(); ++i) {
    const int body = model_.pushed[i];
    if (body >= 0) f[body] += state_.u[static_cast<Eigen::Index>(i)];
  }
  for (const auto& term : model_.terms) term->add_force(state_, f);
}

bool FourStage::in_bounds() const {
  return (x_.array().abs() < out_of_bounds).all();  // false of NaN, too
}

}  // namespace rvbench::sim
