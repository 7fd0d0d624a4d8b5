#pragma once

#include <Eigen/Core>

#include "sim/physics_term.hpp"

namespace rvbench::sim {

/// What a term with a past implements besides PhysicsTerm: a part of PlantState::z is its own.
/// The plant integrates it with everything else; it starts at 0.
class TermMemory {
 public:
  virtual ~TermMemory() = default;
  virtual Eigen::Index size() const = 0;
  virtual void place(Eigen::Index first) = 0;  ///< its part is z[first .. first + size())

  /// Whether its part grows at rates that only inputs and steady speeds decide: a phase, no past.
  virtual bool is_clock() const { return false; }

  /// Adds dz/dt of its part.
  /// @param rates  size of the whole z, in/out
  virtual void add_rates(const PlantState& s, Eigen::Ref<Eigen::VectorXd> rates) const = 0;
};

}  // namespace rvbench::sim
