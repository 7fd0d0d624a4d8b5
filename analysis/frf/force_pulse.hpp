#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// The strongest pulse of a hammer's force.
struct ForcePulse {
  Eigen::Index first = 0;  ///< where it rises above a tenth of its peak
  Eigen::Index peak = 0;
  Eigen::Index last = 0;     ///< last sample above a tenth
  double rest = 0;           ///< median of the force, in [u]
  double height = 0;         ///< at the peak, over rest; signed, in [u]
  double noise = 0;          ///< standard deviation away from the pulse, in [u]
  double second_height = 0;  ///< largest rise after the force had fallen, before or after the pulse
  Eigen::Index second = 0;   ///< where that is

  Eigen::Index width() const { return last - first + 1; }
  /// Samples from the record's first on that are surely before the hit; 0 if they are too few for
  /// a mean to be told.
  Eigen::Index samples_at_rest() const {
    constexpr Eigen::Index fewest = 8;
    return first - width() < fewest ? 0 : first - width();
  }
  /// How much of the pulse the second one is.
  double second_share() const { return second_height / std::abs(height); }
  /// A second pulse of less than this share cannot be told from noise.
  double least_share_seen() const { return noise_widths * noise / std::abs(height); }

  /// Of Gaussian noise one rise in a million samples is this many standard deviations: a rise is
  /// the difference of two samples.
  static constexpr double noise_widths = 8;
};

/// The pulse of a record that holds one hit, or finds out that there are two.
///
/// A second pulse need not be apart from the first: it is a rise of the force after it had begun to
/// fall (seen from the peak, to both sides), counted from the lowest value in between or from rest,
/// whichever is higher. So neither the undershoot of an AC-coupled amplifier nor its return counts.
///
/// Shape   N >= 16 samples. Units  [u], that of the force
/// Errors  throws std::invalid_argument: too few samples, or one not finite
/// Limits  ringing of the anti-aliasing filter counts like a pulse; the noise is told by the
///         median deviation, so that pulses must fill less than a quarter of the record
/// Source  ours; the noise: Rousseeuw & Croux, J. Am. Stat. Assoc. 88, 1273-1283 (1993)
ForcePulse force_pulse(const Eigen::Ref<const Eigen::VectorXd>& force);

}  // namespace rvbench::analysis
