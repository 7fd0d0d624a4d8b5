#pragma once

#include <cstdint>
#include <random>

namespace rvbench::sim {

/// Broadband force of a rough, lubricated contact: asperities strike in proportion to how hard
/// the surfaces are pressed together and how fast they slide.
///
///     f = g·|F|·(v/v_ref)·w,   w: unit-variance noise through one pole
///
/// Leaves out: starvation, running-in, the exponent's weak dependence on film thickness.
/// Source: Mark, J. Acoust. Soc. Am. 63, 1409-1430 (1978), for noise that follows the mesh force
class ContactNoise {
 public:
  /// @param pole  of the colouring filter, within (−1, 1)
  ContactNoise(double gain, double pole, std::uint64_t seed);

  double force_N(double pressed_N, double relative_speed);

 private:
  double gain_;
  double pole_;
  double drive_;  ///< √(1 − pole²)
  double state_ = 0;
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

}  // namespace rvbench::sim
