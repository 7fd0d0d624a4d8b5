#pragma once

#include <Eigen/Core>
#include <vector>

namespace rvbench::sim {

/// One mode of the housing with its shape at the force ports and at the sensors.
struct HousingMode {
  double frequency_Hz = 0;
  double damping_ratio = 0;
  Eigen::VectorXd at_ports;    ///< mass-normalised shape, 1/√kg, one per force port
  Eigen::VectorXd at_sensors;  ///< the same, one per sensor
};

/// From forces inside the reducer to accelerations on its housing.
///
///     d²η/dt² + 2ζω·dη/dt + ω²·η = φᵀ·f,   a = Σ φ·d²η/dt²
///
/// Each mode is stepped exactly for forces that are constant over a step.
/// Leaves out: rigid-body motion on the mounts, modes above the sampled band.
/// Source: Ewins, Modal Testing, 2nd ed., §2.4; step: Franklin & Powell, Digital Control, §4.3
class HousingPath {
 public:
  /// @throws std::invalid_argument if a mode is not below rate_Hz/2, not damped, or has shapes of
  ///         another size than the first
  HousingPath(const std::vector<HousingMode>& modes, double rate_Hz);

  Eigen::Index ports() const { return shape_ports_.cols(); }
  Eigen::Index sensors() const { return shape_sensors_.rows(); }

  /// Accelerations [m/s²] at the sensors while forces [N] act at the ports; then one step on.
  void step(const Eigen::Ref<const Eigen::VectorXd>& forces_N,
            Eigen::Ref<Eigen::VectorXd> accelerations_m_s2);

 private:
  Eigen::MatrixXd shape_ports_;     ///< modes x ports
  Eigen::MatrixXd shape_sensors_;   ///< sensors x modes
  Eigen::ArrayXd spring_, damper_;  ///< ω², 2ζω
  Eigen::ArrayXd a11_, a12_, a21_, a22_, b1_, b2_;
  Eigen::ArrayXd eta_, rate_, next_;
  Eigen::VectorXd drive_, answer_;
};

}  // namespace rvbench::sim
