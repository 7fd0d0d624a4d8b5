#include "bench/missing_force.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace rvbench::bench {
namespace {

using analysis::LockedTo;

constexpr std::size_t most_sites = 6;
constexpr std::size_t most_lines = 3;

bool mean_differs(const std::vector<analysis::ResidualCluster>& located) {
  return std::ranges::any_of(located,
                             [](const auto& c) { return c.locked_to == LockedTo::nothing; });
}

std::string site_text(const ForceSite& site) { return (site.is_joint ? "in " : "on ") + site.name; }

// "in stage_1 (or in stage_2)"
std::string sites_text(const MissingForce& missing, const std::vector<std::size_t>& sites) {
  std::vector<std::string> others;
  for (std::size_t i = 1; i < std::min(sites.size(), most_sites); ++i) {
    others.push_back(site_text(missing.sites[sites[i]]));
  }
  if (sites.size() > most_sites) {
    others.push_back(fmt::format("{} more", sites.size() - most_sites));
  }
  const std::string first = site_text(missing.sites[sites.front()]);
  return others.empty() ? first : fmt::format("{} (or {})", first, fmt::join(others, ", "));
}

std::string lines_text(const analysis::Pushes& pushes, const std::vector<std::size_t>& lines) {
  std::vector<std::string> places;
  for (std::size_t i = 0; i < std::min(lines.size(), most_lines); ++i) {
    const analysis::LinePushes& line = pushes.lines[lines[i]];
    places.push_back(line.locked_to == LockedTo::shaft ? fmt::format("order {:.5g}", line.place)
                                                       : fmt::format("{:.5g} Hz", line.place));
  }
  if (lines.size() > most_lines) {
    places.push_back(fmt::format("{} more", lines.size() - most_lines));
  }
  return fmt::format("{}", fmt::join(places, ", "));
}

}  // namespace

MissingForce find_missing_force(const PushedFeatures& features,
                                const std::vector<analysis::ResidualCluster>& located) {
  MissingForce missing{features.sites,      analysis::find_pushes(features.lines, located),
                       features.transducer, features.left,
                       features.right,      {}};
  if (mean_differs(located)) missing.balances = analysis::torque_balances(features.means);
  return missing;
}

std::string source_text(const MissingForce& missing, const analysis::PushSource& source) {
  const analysis::LinePushes& first = missing.pushes.lines[source.lines.front()];
  const auto best = std::ranges::find(first.sites, source.sites.front(), &analysis::SitePush::site);
  const std::string share = fmt::format("explains {:.0f} ± {:.0f} %", 100 * best->share,
                                        std::ceil(100 * best->standard_error));
  const std::string lines = lines_text(missing.pushes, source.lines);
  const ForceSite& site = missing.sites[best->site];
  return fmt::format("{}: a force {} {}; {:.2g} {} on {}", lines, sites_text(missing, source.sites),
                     share, best->size, site.unit, site.on);
}

std::string balance_text(const MissingForce& missing, const analysis::SideBalance& balance) {
  const bool is_left = balance.side == analysis::Side::left;
  return fmt::format(
      "means: {} of {} ({}), {} differs by {:+.2g} ± {:.1g} N·m ({:+.2g} to {:+.2g}; {})",
      to_string(balance.side), missing.transducer,
      fmt::join(is_left ? missing.left : missing.right, ", "), is_left ? "drive" : "drag",
      balance.mean_Nm, balance.standard_error_Nm, balance.least_Nm, balance.most_Nm,
      law_text(balance));
}

std::vector<std::string> told(const MissingForce& missing, std::size_t most_sources) {
  std::vector<std::string> lines;
  for (const analysis::PushSource& source : missing.pushes.sources) {
    if (lines.size() < most_sources) lines.push_back(source_text(missing, source));
  }
  for (const analysis::SideBalance& balance : missing.balances) {
    lines.push_back(balance_text(missing, balance));
  }
  return lines;
}

}  // namespace rvbench::bench
