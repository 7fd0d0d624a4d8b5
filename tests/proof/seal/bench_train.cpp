#include "tests/proof/seal/bench_train.hpp"

#include <cmath>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>

namespace seal {
namespace {

constexpr double pole_pairs = 2;
constexpr double nominal_Hz = 50;
constexpr double turn = 2 * std::numbers::pi;
constexpr int tooth_harmonics = 4;

// What comes with every tooth of the sun; harmonics fall as 1/h.
TurnTable of_teeth(double teeth, double size, double phase_rad, double shift_rad) {
  return TurnTable([=](double angle_rad) {
    double sum = 0;
    for (int h = 1; h <= tooth_harmonics; ++h) {
      sum += size / h * std::cos(h * (teeth * angle_rad + phase_rad) + shift_rad);
    }
    return sum;
  });
}

Structure train_of(const BenchNumbers& n) {
  Structure train;
  train.inertia = {n.motor_inertia,     n.sun_inertia,     n.planet_inertia[0],
                   n.planet_inertia[1], n.carrier_inertia, n.brake_inertia};
  train.add_spring(motor, sun, n.coupling_stiffness, n.coupling_damping);
  train.add_spring(carrier, brake, n.output_stiffness, n.output_damping);
  train.add_spring(sun, -1, 0, n.sun_drag);
  train.add_spring(brake, -1, 0, n.brake_drag);
  for (int i = 0; i < 2; ++i) {
    Eigen::VectorXd mesh = Eigen::VectorXd::Zero(train_bodies), stage = mesh;
    mesh[sun] = n.sun_radius_m;
    mesh[carrier] = -n.sun_radius_m;
    mesh[planet_1 + i] = -n.planet_radius_m;
    train.links.push_back({mesh, n.mesh[std::size_t(i)].stiffness, n.mesh[std::size_t(i)].damping});
    stage[planet_1 + i] = 1 / n.pins;
    stage[carrier] = -1;
    train.links.push_back(
        {stage, n.stage[std::size_t(i)].stiffness, n.stage[std::size_t(i)].damping});
  }
  return train;
}

}  // namespace

void Structure::add_spring(int first, int second, double stiffness, double damping) {
  Eigen::VectorXd arm = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(inertia.size()));
  arm[first] = 1;
  if (second >= 0) arm[second] = -1;
  links.push_back({std::move(arm), stiffness, damping});
}

BenchTrain::BenchTrain(const BenchNumbers& n, std::vector<BenchEffect*> effects, double step_s)
    : numbers_(n),
      effects_(std::move(effects)),
      step_s_(step_s),
      errors_{of_teeth(n.sun_teeth, n.mesh[0].error_m, n.mesh[0].error_phase_rad, 0),
              of_teeth(n.sun_teeth, n.mesh[1].error_m, n.mesh[1].error_phase_rad, 0)},
      ripples_{of_teeth(n.sun_teeth, n.mesh[0].ripple, n.mesh[0].error_phase_rad,
                        n.mesh[0].ripple_phase_rad),
               of_teeth(n.sun_teeth, n.mesh[1].ripple, n.mesh[1].error_phase_rad,
                        n.mesh[1].ripple_phase_rad)} {
  Structure train = train_of(n);
  for (BenchEffect* effect : effects_) effect->join(train);
  const auto bodies = static_cast<Eigen::Index>(train.inertia.size());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(bodies, bodies), damping = stiffness;
  for (const Structure::Link& link : train.links) {
    Eigen::VectorXd arm = Eigen::VectorXd::Zero(bodies);
    arm.head(link.arm.size()) = link.arm;
    stiffness += link.stiffness * arm * arm.transpose();
    damping += link.damping * arm * arm.transpose();
  }
  const Eigen::MatrixXd mobility =
      Eigen::Map<const Eigen::VectorXd>(train.inertia.data(), bodies).cwiseInverse().asDiagonal();
  // exp of [A B 0 0; 0 0 1 0; 0 0 0 1; 0 0 0 0] holds what forces that stay, grow and bend do
  // within one step.
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(5 * bodies, 5 * bodies);
  all.block(0, bodies, bodies, bodies).setIdentity();
  all.block(bodies, 0, bodies, bodies) = -mobility * stiffness;
  all.block(bodies, bodies, bodies, bodies) = -mobility * damping;
  all.block(bodies, 2 * bodies, bodies, bodies) = mobility;
  all.block(2 * bodies, 3 * bodies, bodies, bodies).setIdentity() /= step_s;
  all.block(3 * bodies, 4 * bodies, bodies, bodies).setIdentity() /= step_s;
  const Eigen::MatrixXd step = (all * step_s).exp();
  decay_ = step.topLeftCorner(2 * bodies, 2 * bodies);
  by_now_ = step.block(0, 2 * bodies, 2 * bodies, bodies);
  by_change_ = step.block(0, 3 * bodies, 2 * bodies, bodies);
  by_bend_ = step.block(0, 4 * bodies, 2 * bodies, bodies);
  state_ = Eigen::VectorXd::Zero(2 * bodies);
  q_ = v_ = remainder_Nm_ = before_Nm_ = before_that_Nm_ = Eigen::VectorXd::Zero(bodies);
}

void BenchTrain::push_meshes() {
  const double seen = q_[sun] - q_[carrier];
  for (int i = 0; i < 2; ++i) {
    const BenchNumbers::Mesh& mesh = numbers_.mesh[std::size_t(i)];
    const double sun_rad = seen - mesh.place_rad, planet_rad = q_[planet_1 + i];
    double error_m = error_factor_ * errors_[i](sun_rad), ripple = ripples_[i](sun_rad);
    for (BenchEffect* effect : effects_) {
      error_m += effect->mesh_error_m(i, sun_rad, planet_rad);
      ripple -= effect->mesh_softening(i, sun_rad);
    }
    const double pressed_m = numbers_.sun_radius_m * seen - numbers_.planet_radius_m * planet_rad;
    const double force_N = mesh.stiffness * ((1 + ripple) * (pressed_m + error_m) - pressed_m);
    remainder_Nm_[sun] -= numbers_.sun_radius_m * force_N;
    remainder_Nm_[carrier] += numbers_.sun_radius_m * force_N;
    remainder_Nm_[planet_1 + i] += numbers_.planet_radius_m * force_N;
  }
}

void BenchTrain::push_stages() {
  for (int i = 0; i < 2; ++i) {
    double error_rad = 0;
    for (BenchEffect* effect : effects_) {
      error_rad += effect->stage_error_rad(i, q_[planet_1 + i] - q_[carrier]);
    }
    const double torque_Nm = numbers_.stage[std::size_t(i)].stiffness * error_rad;
    remainder_Nm_[planet_1 + i] -= torque_Nm / numbers_.pins;
    remainder_Nm_[carrier] += torque_Nm;
  }
}

void BenchTrain::find_remainder() {
  remainder_Nm_.setZero();
  const double synchronous = turn * supply_Hz_ / pole_pairs,
               nominal = turn * nominal_Hz / pole_pairs;
  const double slip = (synchronous - v_[motor]) / nominal / numbers_.pull_out_slip;
  const double motor_Nm = 2 * numbers_.pull_out_torque_Nm * slip / (1 + slip * slip);
  remainder_Nm_[motor] += motor_Nm * (1 + numbers_.motor_ripple * std::cos(6 * electrical_rad_));
  remainder_Nm_[sun] -=
      friction_factor_ * numbers_.sun_friction_Nm * std::tanh(v_[sun] / numbers_.creep_rad_s);
  remainder_Nm_[brake] -= brake_Nm_;
  push_meshes();
  push_stages();
  const Moment now{time_s_,   supply_Hz_, electrical_rad_,
                   brake_Nm_, motor_Nm,   turn * supply_Hz_ - pole_pairs * v_[motor],
                   q_,        v_};
  passed_Nm_ = 0;
  for (BenchEffect* effect : effects_) {
    effect->push(now, step_s_, remainder_Nm_);
    passed_Nm_ += effect->coupling_Nm(now);
  }
  remainder_Nm_[motor] -= passed_Nm_;
  remainder_Nm_[sun] += passed_Nm_;
}

void BenchTrain::step() {
  supply_Hz_ = asked_Hz_;
  for (BenchEffect* effect : effects_) supply_Hz_ = effect->supply_Hz(time_s_, supply_Hz_);
  find_remainder();
  if (is_first_) before_Nm_ = before_that_Nm_ = remainder_Nm_;
  is_first_ = false;
  // A parabola through this force and the two before it goes on through the step.
  const Eigen::VectorXd bend_Nm = remainder_Nm_ - 2 * before_Nm_ + before_that_Nm_;
  state_ = decay_ * state_ + by_now_ * remainder_Nm_ +
           by_change_ * (remainder_Nm_ - before_Nm_ + 0.5 * bend_Nm) + by_bend_ * bend_Nm;
  before_that_Nm_ = before_Nm_;
  before_Nm_ = remainder_Nm_;
  q_ = state_.head(q_.size());
  v_ = state_.tail(v_.size());
  electrical_rad_ = std::fmod(electrical_rad_ + turn * supply_Hz_ * step_s_, turn);
  time_s_ += step_s_;
}

double BenchTrain::coupling_Nm() const {
  double torque_Nm = numbers_.coupling_stiffness * (q_[motor] - q_[sun]) +
                     numbers_.coupling_damping * (v_[motor] - v_[sun]) + passed_Nm_;
  for (BenchEffect* effect : effects_) torque_Nm = effect->shown_torque_Nm(time_s_, torque_Nm);
  return torque_Nm;
}

}  // namespace seal
