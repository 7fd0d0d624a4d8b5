#include <cmath>
#include <numbers>
#include <stdexcept>

#include "analysis/kinematics.hpp"

namespace rvbench::analysis {

BearingOrders bearing_orders(const BearingGeometry& b) {
  if (b.rolling_elements < 2) {
    throw std::invalid_argument("bearing_orders: needs at least 2 rolling elements");
  }
  if (!(b.ball_diameter_mm > 0 && b.pitch_diameter_mm > b.ball_diameter_mm)) {
    throw std::invalid_argument(
        "bearing_orders: ball diameter must be > 0 and below the pitch diameter");
  }
  if (!(b.contact_angle_deg >= 0 && b.contact_angle_deg < 90)) {
    throw std::invalid_argument("bearing_orders: contact angle must be within [0, 90) degrees");
  }
  const double ratio = b.ball_diameter_mm / b.pitch_diameter_mm *
                       std::cos(b.contact_angle_deg * std::numbers::pi / 180);
  return {.cage = 0.5 * (1 - ratio),
          .outer = 0.5 * b.rolling_elements * (1 - ratio),
          .inner = 0.5 * b.rolling_elements * (1 + ratio),
          .ball = b.pitch_diameter_mm / b.ball_diameter_mm * (1 - ratio * ratio)};
}

BearingGeometry bearing_of_races(double outer, double inner, double contact_angle_deg) {
  const double cosine = std::cos(contact_angle_deg * std::numbers::pi / 180);
  return {.rolling_elements = static_cast<int>(std::lround(outer + inner)),
          .ball_diameter_mm = (inner - outer) / (inner + outer) / cosine,
          .pitch_diameter_mm = 1,
          .contact_angle_deg = contact_angle_deg};
}

}  // namespace rvbench::analysis
