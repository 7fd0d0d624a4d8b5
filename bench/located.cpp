#include "bench/located.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string>

namespace rvbench::bench {

namespace {

constexpr double clearly_off = 8;         // standard errors, of all conditions together
constexpr double stretch_off = 6;         // likewise, of a stretch of one programme
constexpr std::size_t fewest_in_row = 3;  // conditions
constexpr std::size_t most_places = 3;    // told
constexpr std::size_t fewest_places = 3;  // of programmes: a single one may be a bump in the way

std::size_t conditions_of(const std::vector<analysis::ResidualCell>& cells) {
  std::set<std::string> conditions;
  for (const analysis::ResidualCell& cell : cells) conditions.insert(cell.condition);
  return conditions.size();
}

// Conditions that share a label, where there is one of each of the others.
std::vector<std::vector<std::string>> rows_by(const std::vector<analysis::ResidualCell>& cells,
                                              std::string analysis::ResidualCell::*shared) {
  std::map<std::string, std::set<std::string>> rows;
  for (const analysis::ResidualCell& cell : cells) {
    if (!(cell.*shared).empty()) rows[cell.*shared].insert(cell.condition);
  }
  std::vector<std::vector<std::string>> all;
  for (const auto& [label, conditions] : rows) {
    if (conditions.size() >= fewest_in_row) all.emplace_back(conditions.begin(), conditions.end());
  }
  return all;
}

bool fills_a_row(const analysis::ResidualCluster& cluster, const Located& located) {
  return std::ranges::any_of(located.rows, [&](const std::vector<std::string>& row) {
    return std::ranges::all_of(row, [&](const std::string& condition) {
      return std::ranges::find(cluster.conditions, condition) != cluster.conditions.end();
    });
  });
}

// What stays off under most conditions: places of a programme are its own, lines and means come
// again under others.
std::vector<std::string> what_stays(const Located& located) {
  std::vector<std::string> places;
  std::set<std::string> programmes;
  for (const analysis::ResidualCluster& cluster : located.after) {
    const bool in_programme = cluster.locked_to == analysis::LockedTo::programme;
    if (cluster.together < (in_programme ? stretch_off : clearly_off)) continue;
    if (in_programme) programmes.insert(cluster.conditions.front());
    if (in_programme || 2 * cluster.conditions.size() >= located.conditions ||
        (cluster.is_new && fills_a_row(cluster, located))) {
      places.push_back(place_text(cluster));
    }
    if (in_programme) places.back() += " of " + cluster.conditions.front();
  }
  const bool in_part = 2 * programmes.size() < located.conditions || places.size() < fewest_places;
  return !programmes.empty() && in_part ? std::vector<std::string>() : places;
}

}  // namespace

void weigh_what_stays(const Located& located, analysis::Explanation& explanation) {
  if (explanation.verdict != analysis::ExplainVerdict::null) return;
  std::vector<std::string> places = what_stays(located);
  if (places.empty()) return;
  const std::size_t all = places.size();
  if (all > most_places) places.resize(most_places);
  explanation.verdict = analysis::ExplainVerdict::none_of_the_above;
  explanation.reason =
      fmt::format("something repeatable is missing ({}{}), and no effect of the library is it",
                  fmt::join(places, ", "), all > most_places ? ", ..." : "");
}

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
  Located located{before.all.size(), conditions_of(before.all),
                  analysis::locate(before.all, before.beside),
                  analysis::locate(after.all, after.beside)};
  const auto missing = [&](const analysis::Fit& fit, const auto& places) {
    return find_missing_force(twin.pushed_features(fit.effects, fit.values), places);
  };
  located.missing_before = missing(found.base, located.before);
  located.missing_after = missing(found.fit, located.after);
  located.noise = before.noise;
  located.rows = rows_by(before.all, &analysis::ResidualCell::speed);
  std::ranges::move(rows_by(before.all, &analysis::ResidualCell::load),
                    std::back_inserter(located.rows));
  return located;
}

}  // namespace rvbench::bench
