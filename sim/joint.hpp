#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "sim/terms/one_axis_term.hpp"

namespace rvbench::sim {

/// What a transducer in series with a term is passed: the efforts of all terms that act between the
/// same two bodies, whichever way round. Of a term that acts otherwise: its own effort alone.
class Joint {
 public:
  using Terms = std::vector<std::unique_ptr<PhysicsTerm>>;

  Joint() = default;  ///< passes nothing
  /// @param terms  outlive it
  static Joint at(const Terms& terms, std::size_t term);
  static Joint between(const Terms& terms, int body_a, int body_b);

  double passed(const PlantState& s) const;  ///< N or N·m; positive against growing q_a − q_b
  bool is_linear() const;

 private:
  std::vector<std::pair<const PhysicsTerm*, double>> parts_;  // +1 or −1
};

}  // namespace rvbench::sim
