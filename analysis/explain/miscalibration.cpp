#include "analysis/explain/miscalibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rvbench::analysis {
namespace {

constexpr double beyond_known = 3;     // spreads: so far off nothing is known of it after all,
constexpr double tolerance = 2;        // spreads; what is farther off than that
constexpr double standard_errors = 2;  // by this much more

// Off by more than is known of it, and by more than these data leave open.
bool is_far_off(const ModelParameter& p, double value, double standard_error) {
  const double off = std::abs(value - p.nominal);
  return off > beyond_known * p.spread &&
         off - tolerance * p.spread > standard_errors * standard_error;
}

}  // namespace

std::string miscalibration(const ForwardModel& model, const Fit& fit) {
  for (std::size_t i = 0; i < model.base().size(); ++i) {
    const ModelParameter& p = model.base()[i];
    const bool is_known = p.is_known && std::isfinite(p.low) && std::isfinite(p.high);
    const bool at_low = p.nominal > p.low && fit.values[i] <= p.low + 1e-6 * p.scale;
    const bool at_high = p.nominal < p.high && fit.values[i] >= p.high - 1e-6 * p.scale;
    const auto at = static_cast<Eigen::Index>(i);
    const bool has_error = at < fit.covariance.rows();
    const double error = has_error ? std::sqrt(std::max(fit.covariance(at, at), 0.0)) : 0;
    // Where the data tell less of it than its bounds do, the bound is as good as any place.
    const bool is_told = std::isfinite(p.spread) || error < 0.5 * (p.high - p.low);
    const bool at_bound = is_known && (at_low || at_high) && is_told;
    if (at_bound || is_far_off(p, fit.values[i], error)) {
      const bool is_tolerated = std::isfinite(p.spread);
      const std::string known = is_tolerated ? fmt::format("known as {:.4g} within {:.2g}",
                                                           p.nominal, tolerance * p.spread)
                                             : "the end of where it is looked for";
      return fmt::format("{} had to go to {:.4g} {}, {}", p.name, fit.values[i], p.unit, known);
    }
  }
  return {};
}

}  // namespace rvbench::analysis
