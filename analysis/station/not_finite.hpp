#pragma once

#include <cmath>
#include <initializer_list>
#include <string>

namespace rvbench::analysis {

/// Why there is no answer, where arithmetic left what numbers can hold: "cannot tell: a range is no
/// finite number, for the values are too large or too far apart".
inline std::string not_finite(const std::string& what) {
  return "cannot tell: " + what +
         " is no finite number, for the values are too large or too far apart";
}

inline bool are_finite(std::initializer_list<double> numbers) {
  for (const double number : numbers) {
    if (!std::isfinite(number)) return false;
  }
  return true;
}

}  // namespace rvbench::analysis
