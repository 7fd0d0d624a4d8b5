#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/terms/dry_friction.hpp"

namespace rvbench::sim {

/// Dry friction between the bodies of a plant, solved for stick and slip.
///
/// All friction along one axis is one contact with one speed u. Over a step the contact's force S
/// shifts the speeds at the step's end by −G·S; it is the solution of
///
///     u + Σ G·S(u) = u without friction,   S(u) = Σ L±·tanh(u/v_ε)
///
/// which exists and is unique, for S grows with u. The limits L are extrapolated to mid-step.
class DryContacts {
 public:
  /// Terms on an axis without a free body are none of its business.
  /// @param free  bodies that move freely, in the order of the state
  DryContacts(const std::vector<const DryFriction*>& terms, const std::vector<int>& free);

  bool empty() const { return contacts_.empty(); }
  /// @param gamma  how the state [q; v; ...] answers a constant force on each free body
  void set_step(const Eigen::MatrixXd& gamma);
  void start(const PlantState& s);
  /// Adds the forces foreseen for this step, those of the last, to the forces on free bodies.
  void add_foreseen(Eigen::VectorXd& r) const;
  /// Call before a step, in the state at its start.
  void read_limits(const PlantState& s);
  /// Corrects a step's end for what the forces came to instead.
  /// @param x  [q; v; ...] at the end of the step, in/out  @param s  holds prescribed speeds there
  void correct(const PlantState& s, Eigen::VectorXd& x);

 private:
  struct Share {
    const DryFriction* term;
    DryFriction::Limits now{}, before{}, middle{};
  };
  struct Contact {
    Axis axis;
    Eigen::VectorXd direction;  ///< over free bodies: +1 at a, −1 at b
    Eigen::VectorXd response;   ///< of the state to a force of 1 against u, over a step
    std::vector<Share> shares;
    double force = 0, foreseen = 0, free_speed = 0;
  };
  static double force_at(const Contact& contact, double speed, double& slope);
  static double solve(const Contact& contact, double mobility, double free_speed);

  std::vector<Contact> contacts_;
  Eigen::Index free_bodies_;
  Eigen::MatrixXd mobility_;  ///< G
};

}  // namespace rvbench::sim
