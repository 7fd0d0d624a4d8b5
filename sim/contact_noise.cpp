#include "sim/contact_noise.hpp"

#include <cmath>
#include <stdexcept>

namespace rvbench::sim {

ContactNoise::ContactNoise(double gain, double pole, std::uint64_t seed)
    : gain_(gain), pole_(pole), drive_(std::sqrt(1 - pole * pole)), engine_(seed) {
  if (!(std::abs(pole) < 1)) throw std::invalid_argument("ContactNoise: pole not within (-1, 1)");
}

double ContactNoise::force_N(double pressed_N, double relative_speed) {
  state_ = pole_ * state_ + drive_ * normal_(engine_);
  return gain_ * std::abs(pressed_N) * std::abs(relative_speed) * state_;
}

}  // namespace rvbench::sim
