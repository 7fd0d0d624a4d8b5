#include "analysis/tpa/tpa_faults.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/frf/signed_axis.hpp"
#include "analysis/tpa/line_svd.hpp"
#include "analysis/tpa/sensor_change.hpp"
#include "analysis/tpa/truncation_by_noise.hpp"
#include "analysis/tpa/unexplained_power.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;
using Faults = std::vector<TpaFault>;

std::string percent(double share) {
  if (!std::isfinite(share)) return "an unknown share";
  const std::string digits = std::to_string(share * 100);
  return digits.substr(0, digits.find('.') + 2) + " %";
}

std::string of_lines(Index some, Index all) {
  return "at " + std::to_string(some) + " of " + std::to_string(all) + " lines";
}

void add_rank(const FrfMatrix& frfs, const SensorRoles& roles, const std::vector<bool>& is_used,
              const TpaFaultLimits& limits, Faults& faults) {
  const FrfMatrix indicators = rows_of(frfs, roles.indicators());
  const Eigen::VectorXd floors = noise_floors(indicators);
  const Eigen::MatrixXd sizes = line_svd(indicators.values).singular_values;
  Index used = 0, below = 0, told = 0;
  for (Index line = 0; line < sizes.cols(); ++line) {
    if (!is_used[std::size_t(line)]) continue;
    const Index rank = (sizes.col(line).array() > floors[line]).count();
    ++used;
    told += rank;
    if (rank < sizes.rows()) ++below;
  }
  if (double(below) <= limits.most_lines_below_rank * double(used)) return;
  faults.push_back({TpaFaultKind::rank_below_paths, of_lines(below, used),
                    "the FRFs' noise hides some of the paths' differences; on average " +
                        std::to_string(told / std::max<Index>(used, 1)) + " of " +
                        std::to_string(sizes.rows()) + " forces can be told apart"});
}

void add_sensor(const SensorChange& change, Faults& faults) {
  const std::string numbers = "; then " + percent(change.unexplained_after) + " instead of " +
                              percent(change.unexplained_before) +
                              " of the indicators' power is out of the paths' reach";
  if (change.swapped_with) {
    faults.push_back({TpaFaultKind::directions_swapped,
                      name_of(change.sensor) + " and " + name_of(*change.swapped_with),
                      "in operation they fit the hammer test if they are exchanged" + numbers});
  } else {
    faults.push_back({TpaFaultKind::sign_reversed, name_of(change.sensor),
                      "in operation it fits the hammer test with the other sign" + numbers});
  }
}

void add_missing_path(const UnexplainedPower& power, const SensorRoles& roles, const LineGrid& grid,
                      const TpaFaultLimits& limits, Faults& faults) {
  const bool is_beyond = power.share() > limits.least_unexplained &&
                         power.share() > limits.most_beyond_expected * power.expected_share();
  if (!is_beyond) return;
  Index line = 0;
  (power.outside - power.expected).maxCoeff(&line);
  faults.push_back({TpaFaultKind::missing_path,
                    "near " + name_of(roles.indicators()[std::size_t(power.worst_indicator)]),
                    percent(power.share()) +
                        " of the indicators' power is out of the paths' reach, " +
                        percent(power.expected_share()) + " is expected of noise; most at " +
                        std::to_string(std::lround(grid.frequency_Hz(line))) + " Hz"});
}

}  // namespace

Faults faults_before_inversion(Index indicators, Index paths, const std::vector<bool>& is_used) {
  Faults faults;
  if (indicators <= paths) {
    faults.push_back(
        {TpaFaultKind::too_few_indicators,
         std::to_string(indicators) + " indicators for " + std::to_string(paths) + " paths",
         indicators < paths ? "forces cannot be told from fewer sensors than there are paths"
                            : "forces follow the noise, and nothing is left to check the data by"});
  }
  const Index left_out = std::count(is_used.begin(), is_used.end(), false);
  if (left_out > 0) {
    faults.push_back({TpaFaultKind::incoherent_lines, of_lines(left_out, Index(is_used.size())),
                      "the coherence of the FRFs is too low there; they are left out"});
  }
  return faults;
}

Faults faults_of_inversion(const FrfMatrix& frfs, const OperatingSpectra& operating,
                           const SensorRoles& roles, const PathContributions& contributions,
                           const TpaFaultLimits& limits) {
  const bool errors_are_known = frfs.variances.size() > 0;
  const bool has_more_rows = Index(roles.indicators().size()) > frfs.values.columns;
  Faults faults;
  if (frfs.noise.size() > 0) add_rank(frfs, roles, contributions.is_used, limits, faults);
  std::optional<SensorChange> change;
  if (has_more_rows) change = find_sensor_change(frfs, operating, roles, contributions.is_used);
  if (change && change->unexplained_before > limits.least_unexplained) {
    add_sensor(*change, faults);
  } else if (has_more_rows && errors_are_known) {
    add_missing_path(unexplained_power(frfs, operating, roles, contributions), roles,
                     contributions.grid, limits, faults);
  }
  add_if_not_validated(contributions.validation.score(), limits, faults);
  return faults;
}

void add_if_not_validated(double score, const TpaFaultLimits& limits, Faults& faults) {
  if (score >= limits.least_score) return;
  faults.push_back(
      {TpaFaultKind::not_validated, "over all lines",
       "the paths explain " + percent(score) + " of what sensors show that were not fitted to"});
}

}  // namespace rvbench::analysis
