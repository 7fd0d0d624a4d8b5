#include "sim/robot/modes.hpp"

#include "hal/types/linear_algebra.hpp"
#include "hal/types/require.hpp"
#include "hal/types/units.hpp"

namespace rvbench::sim {

Modes modes_of(const Structure& structure) {
  constexpr Require require{"modes_of"};
  require_sound(structure);
  const auto pairs =
      algebra::generalised_pairs(stiffness_matrix(structure), mass_matrix(structure));
  require(pairs && pairs->values[0] > 1e-11 * pairs->values[pairs->values.size() - 1],
          "the structure is not held: it moves without any spring giving");
  const Eigen::VectorXd& squares = pairs->values;
  Modes modes{squares.cwiseSqrt() / units::two_pi, Eigen::VectorXd::Zero(squares.size()),
              pairs->vectors};
  for (const FlexibleJoint& joint : structure.joints) {
    const Eigen::VectorXd lost = joint.stiffness.cwiseProduct(joint.loss_factor);
    const Eigen::MatrixXd give = give_of(structure, joint) * modes.shapes;
    modes.damping_ratio += 0.5 * (give.cwiseAbs2().transpose() * lost).cwiseQuotient(squares);
  }
  return modes;
}

Eigen::MatrixXcd modal_accelerance(const Modes& modes, const Eigen::VectorXcd& s_per_s) {
  const Eigen::ArrayXcd square = s_per_s.array().square();
  Eigen::MatrixXcd accelerance(s_per_s.size(), modes.count());
  for (Eigen::Index m = 0; m < modes.count(); ++m) {
    const double omega = units::two_pi * modes.frequency_Hz[m];
    const double damper = 2 * modes.damping_ratio[m] * omega;
    accelerance.col(m) = (square / (square + damper * s_per_s.array() + omega * omega)).matrix();
  }
  return accelerance;
}

}  // namespace rvbench::sim
