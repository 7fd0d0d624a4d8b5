#pragma once

#include <set>
#include <vector>

namespace rvbench::sim {

/// A function of an angle, tabulated over one turn and read by linear interpolation. What goes
/// round with a part (its eccentricity, its tooth errors, one bad tooth) is such a function.
class PeriodicTable {
 public:
  PeriodicTable() = default;  ///< zero everywhere, and free to evaluate

  /// Adds amplitude·cos(harmonic·angle + phase).
  PeriodicTable& add_cosine(int harmonic, double amplitude, double phase_rad);

  /// Adds a raised cosine of the given height, width_rad wide at its foot.
  PeriodicTable& add_bump(double centre_rad, double width_rad, double height);

  double operator()(double angle_rad) const;

  /// > 0: that it is made of; of a bump, a hundredth lies above.
  const std::set<int>& harmonics() const { return harmonics_; }

 private:
  static constexpr int size = 8192;  ///< below 5 ‰ of a step's error up to harmonic 200

  void reserve();

  std::set<int> harmonics_;
  std::vector<double> values_;  ///< size + 1: the first value stands again at the end
};

}  // namespace rvbench::sim
