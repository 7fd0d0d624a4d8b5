#pragma once

namespace rvbench::sim {

/// A tap on the housing, as of a soft hammer or a knuckle: one half sine of force.
///
///     F(t) = F0·sin(πt/T),  0 ≤ t < T
///
/// F0 = 100 N and T = 1 ms: assumed, of a light blow with a plastic tip. A further strike begins
/// anew.
/// Leaves out: the mass of what taps, and that it may bounce.
/// Source: Ewins, Modal Testing, 2nd ed., §3.3 (impulse of a hammer)
class HammerTap {
 public:
  /// @param rate_Hz  at which step() is called
  explicit HammerTap(double rate_Hz) : rate_Hz_(rate_Hz) {}

  void strike() { time_s_ = 0; }
  bool is_over() const { return !(time_s_ < width_s); }
  double step();  ///< force [N] now; then one step on

  static constexpr double peak_N = 100;
  static constexpr double width_s = 1e-3;

 private:
  double rate_Hz_;
  double time_s_ = width_s;  ///< since the strike
};

}  // namespace rvbench::sim
