#include "analysis/order/resolution.hpp"

#include <algorithm>
#include <cmath>

#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

constexpr double most_lines_off = 0.1;
constexpr double rounding = 1e-9;  // relative: a record of just enough turns is enough

}  // namespace

bool is_multiple(double order, double of, double off) {
  const double multiple = std::max(1.0, std::round(order / of));
  return std::abs(order - multiple * of) < off * order;
}

double turns_to_part(double order_a, double order_b) {
  constexpr Require require{"turns_to_part"};
  require(std::isfinite(order_a) && std::isfinite(order_b), "an order is not finite");
  require(order_a != order_b, "the two orders are the same");
  return lines_to_part / std::abs(order_a - order_b);
}

bool are_parted(double order_a, double order_b, double turns, double speed_error) {
  constexpr Require require{"are_parted"};
  require(std::isfinite(order_a) && std::isfinite(order_b), "an order is not finite");
  require(turns >= 0 && speed_error >= 0, "turns and speed_error must not be below 0");
  const double apart =
      std::abs(order_a - order_b) - speed_error * (std::abs(order_a) + std::abs(order_b));
  return apart > 0 && apart * turns >= lines_to_part * (1 - rounding);
}

bool is_placed(double order, double turns, double speed_error) {
  return speed_error * std::abs(order) * turns <= most_lines_off;
}

}  // namespace rvbench::analysis
