#include "sim/plant.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "sim/linear_flow.hpp"

namespace rvbench::sim {
namespace {

// By how much of a speed friction may brake in one step: from 1 on Adams-Bashforth is unstable.
constexpr double resolved = 0.25;

std::vector<int> all_bodies(const PlantModel& model) {
  std::vector<int> bodies(static_cast<std::size_t>(model.inertia.size()));
  std::iota(bodies.begin(), bodies.end(), 0);
  return bodies;
}

PlantState start_of(const PlantModel& model) {
  return {model.start_position, model.start_speed, Eigen::VectorXd::Zero(model.memory_size),
          Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.pushed.size()))};
}

// @throws std::invalid_argument: see Plant's constructor
PlantModel checked(PlantModel model, double step_s) {
  if (!(model.inertia.array() > 0).all()) throw std::invalid_argument("Plant: inertia must be > 0");
  if (!(step_s > 0)) throw std::invalid_argument("Plant: step_s must be > 0");
  if (!model.prescribed.empty()) {
    throw std::invalid_argument("Plant: the motion of a body is prescribed");
  }
  return model;
}

}  // namespace

Plant::Plant(PlantModel model, double step_s)
    : model_(checked(std::move(model), step_s)),
      step_s_(step_s),
      contacts_(steep_frictions(), all_bodies(model_)),
      state_(start_of(model_)),
      states_(2 * model_.inertia.size() + model_.memory_size),
      rates_(model_.inertia.size() + model_.memory_size) {
  sort_terms();
  set_flow();
  y_ = Eigen::VectorXd::Zero(states_ + 2 * rates_);
  y_.head(states_) << state_.q, state_.v, state_.z;
  next_ = Eigen::VectorXd::Zero(states_);
  foreseen_ = Eigen::VectorXd::Zero(rates_);
}

// What is 0 at the start depends on the state: it may become anything.
std::vector<const DryFriction*> Plant::steep_frictions() const {
  std::vector<const DryFriction*> steep;
  const PlantState start = start_of(model_);
  for (const auto& term : model_.terms) {
    const auto* dry = dynamic_cast<const DryFriction*>(term.get());
    if (dry == nullptr) continue;
    const auto [forward, backward] = dry->limits(start);
    const double level = std::max(forward, backward);
    const double way = level * dry->mobility(model_.inertia) * step_s_ / dry->creep_speed();
    if (level == 0 || way > resolved) steep.push_back(dry);
  }
  return steep;
}

void Plant::sort_terms() {
  const std::vector<const DryFriction*> steep = steep_frictions();
  for (const auto& term : model_.terms) {
    const bool in_contact = std::find(steep.begin(), steep.end(), term.get()) != steep.end();
    if (!term->is_linear() && !in_contact) smooth_.push_back(term.get());
    if (const auto* memory = dynamic_cast<const TermMemory*>(term.get())) {
      memories_.push_back(memory);
    }
  }
}

void Plant::set_flow() {
  const Eigen::Index n = model_.inertia.size(), m = model_.memory_size;
  const auto [stiffness, damping] = linear_parts(model_);
  const LinearBodies bodies(model_.inertia, stiffness, damping);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(states_, states_);
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(states_, rates_);
  a.topLeftCorner(2 * n, 2 * n) = bodies.a;
  b.topLeftCorner(2 * n, n) = bodies.b;
  b.bottomRightCorner(m, m).setIdentity();
  const LinearFlow flow(a, b, step_s_);
  contacts_.set_step(flow.gamma0);
  gamma0_ = flow.gamma0;
  flow_.resize(states_, states_ + 2 * rates_);
  flow_ << flow.phi, flow.gamma0 + flow.gamma1, -flow.gamma1;
}

void Plant::set_input(std::size_t i, double value) {
  const SignalTap& tap = model_.taps.at(i);
  state_.u[static_cast<Eigen::Index>(i)] = tap.gain * value + tap.offset;
}

void Plant::load(const Eigen::VectorXd& x) {
  const Eigen::Index n = state_.q.size();
  state_.q = x.head(n);
  state_.v = x.segment(n, n);
  state_.z = x.segment(2 * n, state_.z.size());
}

void Plant::read_remainder() {
  auto r = y_.segment(states_, rates_);
  r.setZero();
  for (std::size_t i = 0; i < model_.pushed.size(); ++i) {
    const int body = model_.pushed[i];
    if (body >= 0) r[body] += state_.u[static_cast<Eigen::Index>(i)];
  }
  for (const PhysicsTerm* term : smooth_) term->add_remainder(state_, r.head(state_.q.size()));
  for (const TermMemory* memory : memories_) memory->add_rates(state_, r.tail(state_.z.size()));
}

void Plant::step() {
  y_.tail(rates_) = y_.segment(states_, rates_);
  read_remainder();
  if (steps_ == 0) {
    y_.tail(rates_) = y_.segment(states_, rates_);
    contacts_.start(state_);
  }
  next_.noalias() = flow_ * y_;
  if (!contacts_.empty()) {
    contacts_.read_limits(state_);
    foreseen_.setZero();
    contacts_.add_foreseen(foreseen_);
    next_.noalias() += gamma0_ * foreseen_;
    load(next_);
    contacts_.correct(state_, next_);
  }
  y_.head(states_) = next_;
  load(next_);
  state_.t_s = static_cast<double>(++steps_) * step_s_;
}

double Plant::kinetic_energy_J() const { return 0.5 * model_.inertia.dot(state_.v.cwiseAbs2()); }

}  // namespace rvbench::sim
