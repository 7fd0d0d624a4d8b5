#include "analysis/frf/mode_indicator.hpp"

#include <algorithm>
#include <limits>

#include "hal/types/linear_algebra.hpp"
#include "hal/types/parallel_for.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {

namespace {

using Places = std::vector<DegreeOfFreedom>;

std::size_t place_in(Places& places, const DegreeOfFreedom& place) {
  const auto found = std::ranges::find(places, place);
  if (found == places.end()) places.push_back(place);
  return std::size_t(std::ranges::find(places, place) - places.begin());
}

// Which response is at row and column; one column if the grid has holes.
std::vector<std::vector<std::size_t>> grid_of(const std::vector<FrequencyResponse>& responses) {
  Places rows, columns;
  std::vector<std::pair<std::size_t, std::size_t>> at;
  for (const FrequencyResponse& frf : responses) {
    at.emplace_back(place_in(rows, frf.response), place_in(columns, frf.excitation));
  }
  std::vector<std::vector<std::size_t>> grid(
      rows.size(), std::vector<std::size_t>(columns.size(), responses.size()));
  for (std::size_t i = 0; i < at.size(); ++i) grid[at[i].first][at[i].second] = i;
  const bool has_holes = std::ranges::any_of(
      grid, [&](const auto& row) { return std::ranges::find(row, responses.size()) != row.end(); });
  if (!has_holes && rows.size() * columns.size() == responses.size()) return grid;
  grid.assign(responses.size(), {0});
  for (std::size_t i = 0; i < responses.size(); ++i) grid[i][0] = i;
  return grid;
}

}  // namespace

Eigen::MatrixXd mode_indicator(const std::vector<FrequencyResponse>& responses) {
  constexpr Require require{"mode_indicator"};
  require(!responses.empty(), "no response");
  const FrequencyResponse& first = responses.front();
  for (const FrequencyResponse& frf : responses) {
    require(frf.first_Hz == first.first_Hz && frf.step_Hz == first.step_Hz &&
                frf.values.size() == first.values.size(),
            frf.source + ": its lines are not those of the first response");
  }
  const auto grid = grid_of(responses);
  const auto rows = Eigen::Index(grid.size()), columns = Eigen::Index(grid.front().size());
  Eigen::MatrixXd indicator(first.values.size(), std::min(rows, columns));
  parallel_for(std::size_t(first.values.size()), [&](std::size_t line) {
    const auto k = Eigen::Index(line);
    const Eigen::MatrixXcd matrix =
        Eigen::MatrixXcd::NullaryExpr(rows, columns, [&](Eigen::Index i, Eigen::Index j) {
          return responses[grid[std::size_t(i)][std::size_t(j)]].values[k];
        });
    if (!matrix.allFinite()) {
      indicator.row(k).setConstant(std::numeric_limits<double>::quiet_NaN());
    } else if (indicator.cols() == 1) {
      indicator(k, 0) = matrix.norm();
    } else {
      indicator.row(k) = algebra::singular_values(matrix).transpose();
    }
  });
  return indicator;
}

}  // namespace rvbench::analysis
