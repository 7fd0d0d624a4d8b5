#pragma once

#include <array>

namespace rvbench::sim {

/// The low-pass between a sensor and the ADC that samples it: inverse Chebyshev of order n = 10,
/// brought to discrete time by the bilinear transform.
///
///     |H(f)|² = 1/(1 + 1/(ε·T_n(w_s/w))²),   w = tan(π·f/rate),   ε² = 1/(10⁶ − 1)
///
/// Gain    1 at rest, above 0.99 up to 0.4 of the sample rate, below 0.001 (−60 dB) from 0.6 of it
///         on: what folds onto frequencies below 0.4 is down by 60 dB at least
/// Delay   1.4 samples of the ADC at rest, 3.4 at 0.4 of its rate
/// Leaves out: what the signal holds above half of `rate`
/// Source: Parks & Burrus, Digital Filter Design, Wiley (1987), ch. 7. Such a slope is to be had as
///         one chip, the LTC1164-6 (maker's sheet: 64 dB at 1.44 times its cut-off)
class AntiAliasFilter {
 public:
  /// @param rate_Hz      at which step() is called
  /// @param sampling_Hz  rate of the ADC
  /// @throws std::invalid_argument if 0.6 of sampling_Hz is not within (0, rate_Hz/2)
  AntiAliasFilter(double rate_Hz, double sampling_Hz);

  /// Takes the signal's next value. @return what the ADC would see of it, in the same unit
  double step(double value);

 private:
  static constexpr int order = 10;

  // A pair of poles and of zeros: y = b0·x + b1·x₋₁ + b0·x₋₂ − a1·y₋₁ − a2·y₋₂.
  struct Section {
    double b0, b1, a1, a2;
    double first = 0, second = 0;  // what goes into the next and the next but one
  };

  std::array<Section, order / 2> sections_;
};

}  // namespace rvbench::sim
