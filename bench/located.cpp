#include "bench/located.hpp"

#include <fmt/format.h>

namespace rvbench::bench {

std::string place_text(const analysis::ResidualCluster& c) {
  const int digits = c.locked_to == analysis::LockedTo::programme ? 3 : 5;
  const std::string places =
      c.last > c.first ? fmt::format("{:.{}g} to {:.{}g}", c.first, digits, c.last, digits)
                       : fmt::format("{:.{}g}", c.first, digits);
  switch (c.locked_to) {
    case analysis::LockedTo::nothing: break;
    case analysis::LockedTo::shaft: return c.channel + " order " + places;
    case analysis::LockedTo::time: return c.channel + ' ' + places + " Hz";
    case analysis::LockedTo::programme: return c.channel + " at " + places + " s";
  }
  return c.channel + " mean";
}

std::string noise_text(const Twin::Noise& noise) {
  return fmt::format("{}: {} {:.2g} {}", noise.channel, noise.of, noise.standard_deviation,
                     noise.unit);
}

Located locate(const Twin& twin, const analysis::Selection& found) {
  if (found.base.residuals.size() == 0) return {};
  const Twin::Cells before = twin.cells(found.base.effects, found.base.values);
  const Twin::Cells after = twin.cells(found.fit.effects, found.fit.values);
  Located located{before.all.size(), analysis::locate(before.all, before.beside),
                  analysis::locate(after.all, after.beside)};
  const auto missing = [&](const analysis::Fit& fit, const auto& places) {
    return find_missing_force(twin.pushed_features(fit.effects, fit.values), places);
  };
  located.missing_before = missing(found.base, located.before);
  located.missing_after = missing(found.fit, located.after);
  located.noise = before.noise;
  return located;
}

}  // namespace rvbench::bench
