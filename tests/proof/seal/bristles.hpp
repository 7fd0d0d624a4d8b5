#pragma once

#include <cmath>

namespace seal {

/// Bristles that bend before they slide: what dry friction remembers of the way.
/// Source  Canudas de Wit, Olsson, Åström & Lischinsky, IEEE Trans. Autom. Control 40(3), 419-425
///         (1995), eqs. 1-4, over a way of as much bending as holds the friction's level
class Bristles {
 public:
  explicit Bristles(double way_m) : way_m_(way_m) {}

  /// How far they are bent, −1 to 1 of where they slide. Exact for a speed that stays.
  double bent_by(double speed_m_s, double step_s) {
    const double end = speed_m_s < 0 ? -1 : 1;
    bent_ = end + (bent_ - end) * std::exp(-std::abs(speed_m_s) * step_s / way_m_);
    return bent_;
  }

 private:
  double way_m_, bent_ = 0;
};

}  // namespace seal
