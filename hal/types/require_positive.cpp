#include "hal/types/require_positive.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace rvbench {

void require_positive(double value, const std::string& where, const std::string& name) {
  if (std::isfinite(value) && value > 0) return;
  std::ostringstream message;
  message << where << ": " << name << " is " << value << ", must be finite and above 0";
  throw std::invalid_argument(message.str());
}

}  // namespace rvbench
