#include "analysis/explain/pressed.hpp"

#include <cmath>

namespace rvbench::analysis {

double pressed(double standard_errors, double believable) {
  const double part = standard_errors / believable;
  if (!std::isfinite(believable)) return standard_errors;
  return std::copysign(believable * std::sqrt(std::log1p(part * part)), standard_errors);
}

double unpressed(double pressed, double believable) {
  const double part = pressed / believable;
  return std::copysign(believable * std::sqrt(std::expm1(part * part)), pressed);
}

}  // namespace rvbench::analysis
