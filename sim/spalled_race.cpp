#include "sim/spalled_race.hpp"

#include <cmath>
#include <numbers>

#include "hal/types/units.hpp"

namespace rvbench::sim {

SpalledRace::SpalledRace(const Params& p, std::uint64_t seed)
    : p_(p),
      passes_per_turn_(0.5 * p.rolling_elements * (1 + p.ball_diameter_mm / p.pitch_diameter_mm) *
                       (1 + p.slip)),
      engine_(seed) {}

double SpalledRace::force_N(double race_rad, double load_N, double dt_s) {
  if (p_.blow_N_per_N == 0) return 0;
  const double moved_rad = std::remainder(race_rad - last_race_rad_, units::two_pi);
  last_race_rad_ = race_rad;
  until_blow_ -= std::abs(moved_rad) / units::two_pi * passes_per_turn_;
  since_blow_s_ += dt_s;
  if (until_blow_ <= 0) {
    until_blow_ += 1 + 0.01 * normal_(engine_);
    since_blow_s_ = 0;
    strength_N_ = p_.blow_N_per_N * std::abs(load_N) * 0.5 * (1 + std::cos(race_rad));
  }
  if (since_blow_s_ >= p_.duration_s) return 0;
  return strength_N_ * std::sin(std::numbers::pi * since_blow_s_ / p_.duration_s);
}

}  // namespace rvbench::sim
