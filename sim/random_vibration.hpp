#pragma once

#include <Eigen/Core>
#include <complex>
#include <utility>
#include <variant>
#include <vector>

#include "hal/config_reader.hpp"
#include "sim/plant_model.hpp"
#include "sim/random_source.hpp"

namespace rvbench::sim {

/// Frequencies between which a vibration is told: low, low + step, ... up to high.
struct FrequencyBand {
  double low_Hz = 0, high_Hz = 0, step_Hz = 0;

  Eigen::Index size() const { return static_cast<Eigen::Index>((high_Hz - low_Hz) / step_Hz) + 1; }
  double frequency_Hz(Eigen::Index i) const { return low_Hz + double(i) * step_Hz; }
};

/// The random vibration that one output shows within a band.
struct Vibration {
  Eigen::VectorXd density;  ///< one-sided, unit²/Hz, at the band's frequencies
  /// Of the squared envelope of what lies within the band.
  std::vector<RandomForce::Swell> swells;
};

/// Solves the random vibration of a linear plant under constant inputs, by spectral densities.
///
///     S(f) = Σ |H(f)|²·S_F(f)                      independent forces add
///     depth(α) = m·|Σ_f H(f+α)·H*(f)·√(S_F(f+α)·S_F(f))| / Σ_f S(f)
///
/// m is how deep the force swells at α: the envelope shows less of it, because the structure
/// rings longer than a fast swell lasts. Swells of several forces at one frequency add.
///
/// Leaves out: phases of the swells, nonlinear terms, what follows the shaft without chance
///
/// Source  Antoni, Mech. Syst. Signal Process. 21, 597-630 (2007): spectral correlation
class RandomVibration {
 public:
  /// @param plant  outlives the result
  /// @return a fault if a term is neither linear nor a random source, a motion is prescribed, an
  ///         output is no motion of a body, or the plant is not stable
  static std::variant<RandomVibration, hal::ConfigFault> make(
      const PlantSpec& plant, const TermLibrary& library = standard_terms());

  /// @param inputs  of the channels of plant.inputs, in their order
  /// @param output  of the plant's
  Vibration under(const Eigen::VectorXd& inputs, std::size_t output,
                  const FrequencyBand& band) const;

 private:
  RandomVibration(const PlantSpec& plant, PlantModel model)
      : plant_(&plant), model_(std::move(model)) {}

  Eigen::VectorXcd response(std::size_t output, const Eigen::VectorXd& push,
                            const Eigen::VectorXd& frequency_Hz) const;

  const PlantSpec* plant_;
  PlantModel model_;
  std::vector<int> seen_;  ///< body of each output
  Eigen::VectorXcd poles_rad_s_;
  Eigen::MatrixXcd shapes_;         ///< of the bodies' ways, one column for each pole
  Eigen::MatrixXcd participation_;  ///< of a push on each body in each pole
};

}  // namespace rvbench::sim
