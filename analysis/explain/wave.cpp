#include "analysis/explain/wave.hpp"

#include <cmath>

namespace rvbench::analysis {

std::vector<std::size_t> waves_among(const ForwardModel& model,
                                     const std::vector<std::size_t>& effects) {
  std::vector<std::size_t> waves;
  std::size_t at = model.base().size();
  for (const std::size_t effect : effects) {
    const Candidate& candidate = model.library()[effect];
    if (candidate.phasor) waves.push_back(at);
    at += candidate.parameters.size();
  }
  return waves;
}

std::vector<double> as_waves(std::vector<double> values, const std::vector<std::size_t>& waves) {
  for (const std::size_t at : waves) {
    const double cosine = values[at], sine = values[at + 1];
    values[at] = std::hypot(cosine, sine);
    values[at + 1] = std::atan2(sine, cosine);
  }
  return values;
}

std::vector<double> from_waves(std::vector<double> values, const std::vector<std::size_t>& waves) {
  for (const std::size_t at : waves) {
    const double size = values[at], phase_rad = values[at + 1];
    values[at] = size * std::cos(phase_rad);
    values[at + 1] = size * std::sin(phase_rad);
  }
  return values;
}

}  // namespace rvbench::analysis
