#include "analysis/bearing_signatures.hpp"

#include <utility>

namespace rvbench::analysis {

RollingBearing rolling_bearing(const std::string& name, const BearingGeometry& bearing,
                               double race_order, std::size_t first) {
  return {name,       bearing.rolling_elements,
          race_order, bearing_orders(bearing).cage,
          first,      first + 1,
          first + 2,  first + 3};
}

std::vector<Signature> bearing_signatures(const BearingGeometry& bearing, double race_order,
                                          double slip) {
  const BearingOrders o = bearing_orders(bearing);
  const auto signature = [&](const char* component, double order, std::vector<double> sidebands) {
    return Signature{
        .component = component,
        .mechanism = "spall",
        .table4_item = "",
        .order = order * race_order,
        .harmonics = 4,
        .sidebands = std::move(sidebands),
        .slip = slip,
        .shows = Shows::as_blows,
        .depth_limit = 0.125,
        .limit_why = "assumed: a sound race leaves no periodic blows; what noise leaves is less",
        .advice = "replace the bearing; look for the cause in load, fit and grease"};
  };
  // A race that stands has its defect always under the same load. One that turns carries it through
  // the load once per turn.
  const bool inner_stands = bearing.inner_stands;
  const std::vector<double> once_per_turn{race_order}, alike;
  const double cage_in_load = inner_stands ? 1 - o.cage : o.cage;
  Signature cage = signature("bearing_cage", cage_in_load, {});
  cage.mechanism = "wear";
  cage.depth_limit = 0.65;
  cage.limit_why =
      "assumed: rolling elements of unequal size shift the load once per cage turn, too";
  return {signature("bearing_inner", o.inner, inner_stands ? alike : once_per_turn),
          signature("bearing_outer", o.outer, inner_stands ? once_per_turn : alike),
          signature("bearing_ball", o.ball, {cage_in_load * race_order}), std::move(cage)};
}

}  // namespace rvbench::analysis
