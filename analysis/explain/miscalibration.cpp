#include "analysis/explain/miscalibration.hpp"

#include <fmt/format.h>

#include <cmath>

namespace rvbench::analysis {
namespace {

constexpr double beyond_known = 3;  // spreads: so far off nothing is known of it after all

}  // namespace

std::string miscalibration(const ForwardModel& model, const Fit& fit) {
  for (std::size_t i = 0; i < model.base().size(); ++i) {
    const ModelParameter& p = model.base()[i];
    const bool is_known = std::isfinite(p.low) && std::isfinite(p.high);
    const bool at_low = p.nominal > p.low && fit.values[i] <= p.low + 1e-6 * p.scale;
    const bool at_high = p.nominal < p.high && fit.values[i] >= p.high - 1e-6 * p.scale;
    if ((is_known && (at_low || at_high)) ||
        std::abs(fit.values[i] - p.nominal) > beyond_known * p.spread) {
      const double within = is_known ? 0.5 * (p.high - p.low) : beyond_known * p.spread;
      return fmt::format("{} had to go to {:.4g} {}, known as {:.4g} within {:.2g}", p.name,
                         fit.values[i], p.unit, p.nominal, within);
    }
  }
  return {};
}

}  // namespace rvbench::analysis
