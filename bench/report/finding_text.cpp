#include "bench/report/finding_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace rvbench::bench::report {
namespace {

std::string power_of(const char* what, const analysis::Growth& growth) {
  return fmt::format("{}^{:.2f} (± {:.2f} at 95 %)", what, growth.exponent, growth.error);
}

constexpr double a_hair = 0.005;  // of the limit

const char* why_refused(Outcome outcome) {
  switch (outcome) {
    case Outcome::invalid: return "the record is refused";
    case Outcome::aborted: return "the run was aborted";
    default: return "the bench was at fault";
  }
}

}  // namespace

std::string severity_text(const analysis::Finding& finding) {
  if (finding.points.empty() && std::isfinite(finding.severity_high)) {
    return fmt::format("below {:.3f}", finding.severity_high);
  }
  if (finding.points.empty()) return "not readable";
  return fmt::format("{:.3f} ({:.3f} to {:.3f})", finding.severity, finding.severity_low,
                     finding.severity_high);
}

std::string limit_text(const analysis::Finding& finding) {
  const bool above = finding.severity > finding.limit;
  const char* side = above ? "above its limit" : "within its limit";
  const double share = finding.severity / finding.limit;
  if (!std::isfinite(share)) return fmt::format("{} of {:.3g}", side, finding.limit);
  if (std::abs(share - 1) < a_hair) return fmt::format("{}, by less than 0.5 %", side);
  return fmt::format("{}, {:.2f} {}", side, share, above ? "times it" : "of it");
}

std::string sound_text(const analysis::Finding& finding) {
  if (std::isnan(finding.over_sound)) return "";
  const bool above = finding.over_sound >= 0;
  return fmt::format("{:.1f} times their scatter {} the median of sound units",
                     std::abs(finding.over_sound), above ? "above" : "below");
}

bool is_close(const analysis::Finding& finding) {
  return finding.severity_low < finding.limit && finding.limit < finding.severity_high;
}

std::string seen_but(const Ending& ending) {
  return fmt::format("seen, but {}: {}", why_refused(ending.outcome), ending.reason);
}

std::string p_text(double p_value) {
  if (!std::isfinite(p_value)) return "–";
  return p_value < 1e-15 ? "< 1e-15" : fmt::format("{:.1e}", p_value);
}

std::string growth_text(const analysis::Finding& finding) {
  std::string text;
  if (std::isfinite(finding.growth.load.exponent)) text = power_of("load", finding.growth.load);
  if (std::isfinite(finding.growth.speed.exponent)) {
    text += (text.empty() ? "" : " and ") + power_of("speed", finding.growth.speed);
  }
  if (text.empty()) return "";
  return "its vibration goes as " + text +
         (finding.growth_fits
              ? ""
              : fmt::format(": not what this mechanism makes (p {:.2g}), look for another cause",
                            finding.growth_p_value));
}

std::string rivals_text(const analysis::Finding& finding) {
  if (finding.cannot_tell_from.empty()) return "";
  return fmt::format("cannot be told from {}: it has lines at the same orders",
                     fmt::join(finding.cannot_tell_from, " or "));
}

std::string cause_text(const analysis::Finding& finding) {
  if (finding.may_follow_from.empty()) return "";
  return "may be a consequence of " + finding.may_follow_from;
}

std::string advice_text(const analysis::Finding& finding) {
  if (finding.may_follow_from.empty()) return finding.advice;
  return fmt::format("mend {} first; then {}", finding.may_follow_from, finding.advice);
}

}  // namespace rvbench::bench::report
