#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

namespace rvbench::sim {

/// State of n bodies; each is rotational (rad, rad/s) or translational (m, m/s), as declared.
struct PlantState {
  Eigen::VectorXd q;       ///< coordinates, size n
  Eigen::VectorXd v;       ///< speeds, size n
  Eigen::VectorXd z = {};  ///< what terms remember, each in its own units: see TermMemory
  Eigen::VectorXd u = {};  ///< the inputs of the plant at this time, SI
  double t_s = 0;          ///< since the start
};

/// Adds |turns|, as a whole number, unless nothing turns.
inline void add_order(double turns, std::set<int>& orders) {
  if (turns != 0) orders.insert(static_cast<int>(std::abs(turns)));
}

/// One physical effect. The plant sums its terms; a term never knows its neighbours.
///
/// Each term keeps its energy book, so that the plant's books must balance:
/// d/dt(kinetic + Σ stored) = Σ supplied − Σ dissipated.
class PhysicsTerm {
 public:
  virtual ~PhysicsTerm() = default;
  virtual std::string_view name() const = 0;  ///< stable: plant files and reports use it

  /// Adds (never assigns) this term's generalized force on every body.
  /// @param f  size n, in/out; N·m on a rotational body, N on a translational one
  virtual void add_force(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const = 0;

  virtual double stored_energy_J(const PlantState& s) const = 0;     ///< 0 if purely dissipative
  virtual double dissipated_power_W(const PlantState& s) const = 0;  ///< >= 0
  virtual double supplied_power_W(const PlantState&) const { return 0; }  ///< by a source

  /// What its (first) body has to give to the term: a spring's pull, friction against motion; of a
  /// source, minus its push. N or N·m; NaN if no single number says it.
  virtual double effort(const PlantState&) const {
    return std::numeric_limits<double>::quiet_NaN();
  }

  /// How fast the remainder may turn, so that a step can resolve it.
  /// @param inertia  kg or kg·m², size n
  /// @return rad/s; 0 if it adds nothing faster than the bodies' own motion
  virtual double fastest_rad_s(const Eigen::VectorXd& inertia) const {
    (void)inertia;
    return 0;
  }

  /// The one frequency of what follows time in the push, and not motion; 0 if nothing does.
  virtual double rhythm_Hz(const PlantState&) const { return 0; }

  /// Adds how often each wave of its push comes again while the bodies make these turns: nothing if
  /// it does not know where on that motion they are. What ways and speeds between the bodies bring
  /// is not its own.
  /// @param turns   whole numbers, with their signs
  /// @param orders  > 0
  virtual void add_orders(const Eigen::VectorXd& turns, std::set<int>& orders) const = 0;

  virtual bool is_linear() const { return false; }  ///< add_remainder() has nothing to add

  /// Whether add_remainder() depends on time and inputs alone: no step has to resolve it.
  virtual bool is_affine() const { return is_linear(); }

  /// Adds the linear, constant part of the force, f = −K·q − C·v: the plant integrates it exactly.
  virtual void add_linear(Eigen::MatrixXd& stiffness, Eigen::MatrixXd& damping) const {
    (void)stiffness;
    (void)damping;
  }

  /// Adds what add_force() gives beyond the linear part: evaluated once per step.
  virtual void add_remainder(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const {
    add_force(s, f);
  }
};

}  // namespace rvbench::sim
