#include "analysis/tpa/sensor_roles.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "analysis/frf/signed_axis.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;
using Places = std::vector<DegreeOfFreedom>;

Places all_positive(Places places) {
  for (DegreeOfFreedom& place : places) place = positive(place);
  return places;
}

void require_distinct(const Places& places, const std::string& role) {
  constexpr Require require{"SensorRoles"};
  require(!places.empty(), "no sensor is " + role);
  for (const DegreeOfFreedom& place : places) {
    require(std::count(places.begin(), places.end(), place) == 1,
            name_of(place) + " is " + role + " twice");
  }
}

std::vector<Index> indices_of(const Places& places, const Places& all) {
  constexpr Require require{"SensorRoles"};
  std::vector<Index> rows;
  for (const DegreeOfFreedom& place : all_positive(places)) {
    require(holds(all, place), name_of(place) + " is not there");
    rows.push_back(std::find(all.begin(), all.end(), place) - all.begin());
  }
  return rows;
}

LineMatrices rows_of(const LineMatrices& all, const std::vector<Index>& rows) {
  LineMatrices some = LineMatrices::unset(Index(rows.size()), all.columns, all.lines);
  for (Index line = 0; line < all.lines; ++line) some[line] = all[line](rows, Eigen::all);
  return some;
}

// What is known of each pair, of these rows alone; nothing if nothing is known.
Eigen::MatrixXd pairs_of(const FrfMatrix& frfs, const Eigen::MatrixXd& all,
                         const std::vector<Index>& rows) {
  if (all.size() == 0) return {};
  const Index count = Index(rows.size());
  Eigen::MatrixXd some(count * frfs.values.columns, all.cols());
  for (Index column = 0; column < frfs.values.columns; ++column) {
    for (Index i = 0; i < count; ++i) {
      some.row(column * count + i) = all.row(column * frfs.values.rows + rows[std::size_t(i)]);
    }
  }
  return some;
}

}  // namespace

SensorRoles::SensorRoles(Places indicators, Places targets, Places validation)
    : indicators_(all_positive(std::move(indicators))),
      targets_(all_positive(std::move(targets))),
      validation_(all_positive(std::move(validation))) {
  constexpr Require require{"SensorRoles"};
  require_distinct(indicators_, "an indicator");
  require_distinct(targets_, "a target");
  require_distinct(validation_, "for validation");
  for (const DegreeOfFreedom& place : indicators_) {
    require(!holds(targets_, place), name_of(place) + " is both indicator and target");
    require(!holds(validation_, place), name_of(place) + " is an indicator and cannot validate");
  }
}

FrfMatrix rows_of(const FrfMatrix& frfs, const Places& places) {
  const std::vector<Index> rows = indices_of(places, frfs.responses);
  FrfMatrix some = frfs;
  some.responses = all_positive(places);
  some.values = rows_of(frfs.values, rows);
  some.variances = pairs_of(frfs, frfs.variances, rows);
  some.noise = pairs_of(frfs, frfs.noise, rows);
  return some;
}

OperatingSpectra rows_of(const OperatingSpectra& spectra, const Places& places) {
  return {all_positive(places), spectra.unit, spectra.grid,
          rows_of(spectra.values, indices_of(places, spectra.places))};
}

bool is_on_lines_of(const OperatingSpectra& spectra, const FrfMatrix& frfs) {
  const LineGrid& grid = spectra.grid;
  return grid.lines == frfs.values.lines && spectra.values.lines == grid.lines &&
         std::abs(grid.first_Hz - frfs.first_Hz) < 1e-6 * frfs.step_Hz &&
         std::abs(grid.step_Hz - frfs.step_Hz) * double(grid.lines) < 0.05 * frfs.step_Hz;
}

}  // namespace rvbench::analysis
