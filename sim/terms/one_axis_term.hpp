#pragma once

#include "sim/physics_term.hpp"

namespace rvbench::sim {

inline constexpr int housing = -1;  ///< in place of a body: what does not move

/// Between two bodies that move along (or about) one axis, or of one body against the housing.
struct Axis {
  int body_a = 0;
  int body_b = housing;
};

/// A force with a kink is followed to the second order of the step only: such a term asks for
/// steps this many times finer, and the time of a contact is right to 0.2 % of its duration.
inline constexpr double finer_at_kinks = 4;

/// A term that knows one way x = q_a − q_b and one speed of it, and pushes both ends alike.
///
///     f_a = −F,  f_b = +F        F is the term's effort, positive against growing x
class OneAxisTerm : public PhysicsTerm {
 public:
  /// @param name  outlives the term: the type's name in plant files
  OneAxisTerm(std::string_view name, Axis axis) : name_(name), axis_(axis) {}

  std::string_view name() const final { return name_; }
  double effort(const PlantState& s) const override = 0;
  void add_force(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const final {
    give(effort(s), f);
  }
  /// The same; said once more because a step asks for it four times, and each call that hands a
  /// reference on costs as much as the law itself.
  void add_remainder(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const override {
    give(effort(s), f);
  }
  double stored_energy_J(const PlantState&) const override { return 0; }
  double dissipated_power_W(const PlantState&) const override { return 0; }
  /// Of a term that knows way and speed alone; one that knows an angle overrides it.
  void add_orders(const Eigen::VectorXd&, std::set<int>&) const override {}

  Axis axis() const { return axis_; }
  double way(const PlantState& s) const {  ///< x, m or rad
    return axis_.body_b == housing ? s.q[axis_.body_a] : s.q[axis_.body_a] - s.q[axis_.body_b];
  }
  double speed(const PlantState& s) const {  ///< dx/dt
    return axis_.body_b == housing ? s.v[axis_.body_a] : s.v[axis_.body_a] - s.v[axis_.body_b];
  }
  /// 1/kg or 1/(kg·m²): how easily the two ends part.
  double mobility(const Eigen::VectorXd& inertia) const;

 protected:
  void give(double effort, Eigen::Ref<Eigen::VectorXd> f) const {
    f[axis_.body_a] -= effort;
    if (axis_.body_b != housing) f[axis_.body_b] += effort;
  }
  void add_between(Eigen::MatrixXd& m, double value) const;

 private:
  std::string_view name_;
  Axis axis_;
};

/// F = k·x + c·dx/dt: what the plant integrates exactly.
class LinearAxisTerm final : public OneAxisTerm {
 public:
  /// @throws std::invalid_argument if stiffness or damping is not finite
  LinearAxisTerm(std::string_view name, Axis axis, double stiffness, double damping);

  double effort(const PlantState& s) const override {
    return stiffness_ * way(s) + damping_ * speed(s);
  }
  double stored_energy_J(const PlantState& s) const override {
    return 0.5 * stiffness_ * way(s) * way(s);
  }
  double dissipated_power_W(const PlantState& s) const override {
    return damping_ * speed(s) * speed(s);
  }
  bool is_linear() const override { return true; }
  void add_linear(Eigen::MatrixXd& stiffness, Eigen::MatrixXd& damping) const override {
    add_between(stiffness, stiffness_);
    add_between(damping, damping_);
  }
  void add_remainder(const PlantState&, Eigen::Ref<Eigen::VectorXd>) const override {}

 private:
  double stiffness_;
  double damping_;
};

}  // namespace rvbench::sim
