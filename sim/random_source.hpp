#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace rvbench::sim {

/// A random force without mean whose strength comes and goes in step with the machine.
struct RandomForce {
  /// A line of its squared envelope over the envelope's mean.
  struct Swell {
    double frequency_Hz = 0;
    double depth = 0;  ///< 0-to-peak
  };

  Eigen::VectorXd push;                          ///< what one unit of it gives to each body
  std::function<double(double)> density_per_Hz;  ///< one-sided, N²/Hz or (N·m)²/Hz over Hz
  std::vector<Swell> swells;
};

/// What a term whose force is random implements besides PhysicsTerm, so that a plant's vibration
/// can be told without following it through time.
class RandomSource {
 public:
  virtual ~RandomSource() = default;
  /// @param u       the plant's inputs, constant, SI
  /// @param bodies  of the plant
  virtual void add_random(const Eigen::VectorXd& u, Eigen::Index bodies,
                          std::vector<RandomForce>& forces) const = 0;
};

}  // namespace rvbench::sim
