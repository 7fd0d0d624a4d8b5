#pragma once

#include <algorithm>
#include <cmath>

namespace seal {

/// Dry friction of bristles that bend before they slide.
/// Source  Canudas de Wit, Olsson, Åström & Lischinsky, IEEE Trans. Autom. Control 40(3), 419-425
///         (1995), eqs. 1-4
class Bristles {
 public:
  struct Numbers {
    double sliding_N = 0;   ///< > 0, far above creep
    double sticking_N = 0;  ///< >= sliding
    double creep_m_s = 1;   ///< below which it comes to stick
    double stiffness_N_m = 1;
  };
  explicit Bristles(const Numbers& numbers) : n_(numbers) {}

  double force_N(double speed_m_s, double step_s) {
    const double way = speed_m_s / n_.creep_m_s;
    const double level_N = n_.sliding_N + (n_.sticking_N - n_.sliding_N) * std::exp(-way * way);
    if (level_N <= 0) return 0;
    // Exact for a speed that stays: the bending comes to level/stiffness over a way of as much.
    const double end_m = level_N / n_.stiffness_N_m * (speed_m_s < 0 ? -1 : 1);
    const double faded = std::exp(-std::abs(speed_m_s) * step_s * n_.stiffness_N_m / level_N);
    bend_m_ = end_m + (bend_m_ - end_m) * faded;
    return n_.stiffness_N_m * bend_m_;
  }

 private:
  Numbers n_;
  double bend_m_ = 0;
};

}  // namespace seal
