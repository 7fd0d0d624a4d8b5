#include "sim/plant.hpp"

#include <stdexcept>

#include "sim/linear_flow.hpp"

namespace rvbench::sim {

Plant::Plant(Eigen::VectorXd inertia, std::vector<std::unique_ptr<PhysicsTerm>> terms,
             double step_s)
    : inertia_(std::move(inertia)), terms_(std::move(terms)), step_s_(step_s) {
  if (!(inertia_.array() > 0).all()) throw std::invalid_argument("Plant: inertia must be > 0");
  if (!(step_s > 0)) throw std::invalid_argument("Plant: step_s must be > 0");

  const Eigen::Index n = inertia_.size();
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd damping = Eigen::MatrixXd::Zero(n, n);
  for (const auto& term : terms_) term->add_linear(stiffness, damping);

  const LinearBodies bodies(inertia_, stiffness, damping);
  LinearFlow flow(bodies.a, bodies.b, step_s);
  phi_ = std::move(flow.phi);
  gamma0_ = std::move(flow.gamma0);
  gamma1_ = std::move(flow.gamma1);

  x_ = Eigen::VectorXd::Zero(2 * n);
  next_ = x_;
  r_ = Eigen::VectorXd::Zero(n);
  r_before_ = r_;
  load();
}

void Plant::load() {
  const Eigen::Index n = inertia_.size();
  state_.q = x_.head(n);
  state_.v = x_.tail(n);
}

void Plant::step() {
  r_.setZero();
  for (const auto& term : terms_) term->add_remainder(state_, r_);
  if (!has_before_) r_before_ = r_;
  has_before_ = true;

  next_.noalias() = phi_ * x_;
  next_.noalias() += gamma0_ * r_;
  next_.noalias() += gamma1_ * (r_ - r_before_);
  x_.swap(next_);
  r_before_.swap(r_);
  load();
}

double Plant::kinetic_energy_J() const { return 0.5 * inertia_.dot(state_.v.cwiseAbs2()); }

}  // namespace rvbench::sim
