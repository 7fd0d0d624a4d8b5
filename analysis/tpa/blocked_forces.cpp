#include "analysis/tpa/blocked_forces.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;
using Places = std::vector<DegreeOfFreedom>;

void require_outside(const std::vector<std::string>& source, const Places& places) {
  constexpr Require require{"blocked_forces"};
  for (const DegreeOfFreedom& place : places) {
    require(std::find(source.begin(), source.end(), place.point) == source.end(),
            place.point + " is inside the source: blocked forces are found from outside it");
  }
}

// Every other indicator, from the first or the second on.
SensorRoles half_of(const SensorRoles& roles, std::size_t from) {
  Places some;
  for (std::size_t i = from; i < roles.indicators().size(); i += 2) {
    some.push_back(roles.indicators()[i]);
  }
  return {std::move(some), roles.targets(), roles.validation()};
}

double disagreement(const LineMatrices& one, const LineMatrices& other, const LineMatrices& all) {
  const double power = all.values.squaredNorm();
  return power > 0 ? (one.values - other.values).squaredNorm() / power : 0;
}

}  // namespace

BlockedForces blocked_forces(const FrfMatrix& frfs, const OperatingSpectra& operating,
                             const SensorRoles& roles, const std::vector<std::string>& source,
                             const RegularisationRule& rule, std::vector<bool> is_used,
                             unsigned threads) {
  constexpr Require require{"blocked_forces"};
  require(!source.empty(), "no point of the source");
  require_outside(source, roles.indicators());
  require_outside(source, roles.targets());
  require_outside(source, roles.validation());
  const auto found = [&](const SensorRoles& some) {
    return matrix_inverse_contributions(frfs, operating, some, rule, is_used, threads);
  };
  BlockedForces blocked{found(roles), std::numeric_limits<double>::quiet_NaN()};
  if (Index(roles.indicators().size() / 2) <= frfs.values.columns) return blocked;
  blocked.disagreement =
      disagreement(found(half_of(roles, 0)).forces, found(half_of(roles, 1)).forces,
                   blocked.contributions.forces);
  return blocked;
}

}  // namespace rvbench::analysis
