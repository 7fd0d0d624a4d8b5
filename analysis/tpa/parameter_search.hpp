#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "analysis/tpa/regularisation.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {

/// What rules that ask the data need.
/// @throws std::invalid_argument in the name of `where`
inline void require_powers(const char* where, const PicardPowers& line) {
  const Require require{where};
  require(line.powers.size() == line.singular_values.size(), "other powers than singular values");
  require(line.powers.size() > 0 && line.singular_values[0] > 0, "no singular value above 0");
  require(line.rows >= line.powers.size(), "fewer rows than singular values");
}

/// Where rules look for Tikhonov's parameter, in units of the singular values.
struct ParameterRange {
  double from;
  double to;
};

/// From where no singular value is damped in double precision to where all are.
inline ParameterRange parameters_of(const Eigen::VectorXd& singular_values) {
  const double largest = singular_values[0];
  const double least = singular_values[singular_values.size() - 1];
  return {std::max(1e-8 * least, 1e-16 * largest), 10 * largest};
}

/// The parameter at which the function is least: the least of a grid of a tenth of an octave, then
/// golden section between its neighbours.
template <typename Function>
double least_parameter(ParameterRange range, const Function& f) {
  const double step = std::log(2.) / 10;
  const double first = std::log(range.from);
  const int count = int(std::ceil((std::log(range.to) - first) / step));
  int best = 0;
  double least = f(range.from);
  for (int i = 1; i <= count; ++i) {
    const double value = f(std::exp(first + i * step));
    if (value < least) {
      least = value;
      best = i;
    }
  }
  const double golden = (std::sqrt(5.) - 1) / 2;
  double a = first + (best - 1) * step, b = first + (best + 1) * step;
  for (int i = 0; i < 30; ++i) {
    const double c = b - golden * (b - a), d = a + golden * (b - a);
    if (f(std::exp(c)) < f(std::exp(d))) {
      b = d;
    } else {
      a = c;
    }
  }
  return std::exp((a + b) / 2);
}

}  // namespace rvbench::analysis
