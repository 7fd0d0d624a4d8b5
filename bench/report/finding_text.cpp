#include "bench/report/finding_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace rvbench::bench::report {
namespace {

std::string power_of(const char* what, const analysis::Growth& growth) {
  return fmt::format("{}^{:.2f} (± {:.2f} at 95 %)", what, growth.exponent, growth.error);
}

}  // namespace

std::string severity_text(const analysis::Finding& finding) {
  if (!std::isfinite(finding.severity_low)) return fmt::format("{:.3f}", finding.severity);
  return fmt::format("{:.3f} ({:.3f} to {:.3f})", finding.severity, finding.severity_low,
                     finding.severity_high);
}

std::string growth_text(const analysis::Finding& finding) {
  std::string text;
  if (std::isfinite(finding.growth.load.exponent)) text = power_of("load", finding.growth.load);
  if (std::isfinite(finding.growth.speed.exponent)) {
    text += (text.empty() ? "" : " and ") + power_of("speed", finding.growth.speed);
  }
  if (text.empty()) return "";
  return "its vibration goes as " + text +
         (finding.growth_fits ? "" : ": not what this mechanism makes, look for another cause");
}

std::string rivals_text(const analysis::Finding& finding) {
  if (finding.cannot_tell_from.empty()) return "";
  return fmt::format("cannot be told from {}: it has lines at the same orders",
                     fmt::join(finding.cannot_tell_from, " or "));
}

}  // namespace rvbench::bench::report
