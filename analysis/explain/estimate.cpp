#include "analysis/explain/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/explain/wave.hpp"

namespace rvbench::analysis {
namespace {

constexpr double ninety_pct = 1.645;  // standard errors to each side

void tell_as_wave(const Phasor& phasor, Estimate& size, Estimate& phase) {
  size.name = phasor.size;
  size.low = std::max(size.low, 0.0);
  phase.name = phasor.phase;
  phase.unit = "rad";
  phase.low = std::max(phase.low, phase.value - std::numbers::pi);
  phase.high = std::min(phase.high, phase.value + std::numbers::pi);
}

}  // namespace

std::vector<Estimate> estimates(const ForwardModel& model, const Fit& fit) {
  std::vector<Estimate> all;
  const std::vector<ModelParameter> parameters = parameters_of(model, fit.effects);
  const std::vector<double> values = as_waves(fit.values, waves_among(model, fit.effects));
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    const double width = ninety_pct * std::sqrt(std::max(fit.covariance(index, index), 0.0));
    all.push_back(
        {parameters[i].name, parameters[i].unit, values[i], values[i] - width, values[i] + width});
  }
  for (std::size_t place = 0; place < fit.effects.size(); ++place) {
    const auto& phasor = model.library()[fit.effects[place]].phasor;
    if (!phasor) continue;
    const std::size_t at = first_value_of(model, fit.effects, place);
    tell_as_wave(*phasor, all[at], all[at + 1]);
  }
  return all;
}

}  // namespace rvbench::analysis
