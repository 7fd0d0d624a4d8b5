#include "analysis/rv_reducer.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "hal/types/require_positive.hpp"

namespace rvbench::analysis {
namespace {

struct Rates {
  double unit;   // carrier: 1/i
  double sun;    // against the carrier
  double crank;  // and planet, against the carrier
  double orbit;  // crank in the housing
};

void check(const RvGeometry& g) {
  require_positive(g.sun_teeth, "rv_reducer", "sun_teeth");
  require_positive(g.planet_teeth, "rv_reducer", "planet_teeth");
  require_positive(g.planets, "rv_reducer", "planets");
  require_positive(g.lobes, "rv_reducer", "lobes");
  if (g.pins != g.lobes + 1) {
    throw std::invalid_argument("rv_reducer: pins are " + std::to_string(g.pins) +
                                ", must be one more than lobes, " + std::to_string(g.lobes));
  }
}

double ratio(const RvGeometry& g) {
  return 1 + static_cast<double>(g.planet_teeth) / g.sun_teeth * g.pins;
}

// Input turns after which sun, planets and carrier stand as before: the numerator of i.
int period(const RvGeometry& g) {
  const int numerator = g.sun_teeth + g.planet_teeth * g.pins;
  return numerator / std::gcd(numerator, g.sun_teeth);
}

// "1080/121"
std::string fraction(double order, int turns) {
  const auto events = std::lround(order * turns);
  return events == turns ? "1" : std::to_string(events) + "/" + std::to_string(turns);
}

std::vector<CharacteristicOrder> order_table(const RvGeometry& g, const Rates& r) {
  std::vector<CharacteristicOrder> orders{
      {"input shaft", 1, {}, "input_shaft", "Drive shaft frequency"},
      {"sun against carrier", r.sun, {}, "sun_gear", ""},
      {"planet and crank against carrier", r.crank, {}, "planet_gear", ""},
      {"crank in housing", r.orbit, {}, "crank", "Cycloid meshing frequency"},
      {"planet in housing", r.orbit, {}, "planet_gear", "Planetary gear rotation frequency"},
      {"sun-planet mesh",
       g.sun_teeth * r.sun,
       {},
       "sun_gear",
       "Planetary gear meshing frequency",
       true},
      {"pin strike, both discs", 2 * r.orbit, {}, "pin_housing", "Pin tooth meshing frequency"},
      {"pin-lobe pass", g.pins * r.orbit, {}, "cycloid_disc", "", true},
      {"carrier and cycloid disc", r.unit, {}, "carrier", "Cycloidal gear rotation frequency"},
      {"planet pass",
       g.planets * r.unit,
       {},
       "carrier",
       "Pin tooth shell characteristic frequency"},
  };
  for (CharacteristicOrder& o : orders) o.fraction = fraction(o.order, period(g));
  return orders;
}

// The pins see the cranks go round in the housing, the discs' lobes see them turn in the carrier.
std::vector<GearMesh> meshes(const RvGeometry& g, const Rates& r) {
  return {{"sun-planet mesh",
           g.sun_teeth * r.sun,
           {{"sun against carrier", r.sun, g.sun_teeth},
            {"planet against carrier", r.crank, g.planet_teeth}},
           r.unit},
          {"pin-lobe pass",
           g.pins * r.orbit,
           {{"pins against crank", r.orbit, g.pins}, {"lobes against crank", r.crank, g.lobes}},
           r.orbit}};
}

// A bad input shaft or sun: what turns with the motor, or with it against the carrier.
// Equal planets cancel what is alike in their meshes: with two the odd harmonics, whose sidebands
// stay, so that a sound swing seems deeper; with more the first sidebands themselves.
double by_planets(int planets, double one, double two, double more) {
  if (planets == 1) return one;
  return planets == 2 ? two : more;
}

std::vector<Signature> input_signatures(const Rates& r, int planets) {
  return {
      {.component = "input_shaft",
       .mechanism = "misalignment",
       .table4_item = "Drive shaft frequency",
       .order = 1,
       .harmonics = 2,
       .sidebands = {},
       .shows = Shows::as_turning,
       .forces = 2,
       .turn = r.sun,
       .path_order = r.unit,
       .load_growth = grows_as_shape,
       .depth_limit = by_planets(planets, 0.15, 0.25, 0.08),
       .limit_why = "assumed: a shaft within tolerance leans on its bearing by less than a sixth "
                    "of its preload",
       .advice = "stiffen or shorten the input shaft, or support its free end with a bearing; "
                 "check the run-out at the sun and the alignment of the coupling"},
      {.component = "sun_gear",
       .mechanism = "profile_error",
       .table4_item = "Planetary gear meshing frequency",
       .order = r.sun,
       .harmonics = 8,
       .sidebands = {r.unit, 2 * r.unit},
       .shows = Shows::as_teeth,
       .turn = r.sun,
       .path_order = r.unit,
       .load_growth = grows_as_shape,
       .depth_limit = by_planets(planets, 0.1, 0.1, 0.06),
       .limit_why = "assumed: teeth of one quality class share the load within a tenth",
       .advice = "measure the sun gear's tooth profile and pitch; replace the input gear"},
  };
}

// A bad crank, planet or pin: what goes round in the carrier.
std::vector<Signature> carried_signatures(const Rates& r) {
  return {
      {.component = "crank",
       .mechanism = "eccentricity",
       .table4_item = "Cycloid meshing frequency",
       .order = r.orbit,
       .harmonics = 1,
       .sidebands = {r.unit},
       .shows = Shows::as_turning,
       .forces = 1,
       .load_growth = grows_as_shape,
       .depth_limit = 0.3,
       .limit_why = "assumed: equal cranks load the discs alike all the way round",
       .advice = "measure the eccentricity of the cranks against each other"},
      {.component = "planet_gear",
       .mechanism = "tooth_damage",
       .table4_item = "Planetary gear rotation frequency",
       .order = r.crank,
       .first_harmonic = 2,  // once per crank turn is what eccentricity does, too
       .harmonics = 24,
       .sidebands = {r.unit},
       .shows = Shows::as_teeth,
       .strikes = true,
       .turn = r.crank,
       .path_order = r.unit,
       .load_growth = any_growth,
       .depth_limit = 0.05,
       .limit_why = "assumed: one tooth among many may not stand out by more than its share",
       .advice = "open the reducer and look at the planets' flanks; replace the planet pair"},
      {.component = "pin_housing",
       .mechanism = "pin_damage",
       .table4_item = "Pin tooth meshing frequency",
       .order = 2 * r.orbit,
       .first_harmonic = 2,  // the load zones of sound discs pass a sensor twice per orbit, too
       .harmonics = 8,
       .sidebands = {r.orbit},
       .shows = Shows::as_teeth,
       .strikes = true,
       .turn = r.orbit,
       .load_growth = any_growth,
       .depth_limit = 0.05,
       .limit_why = "assumed: pins of one class share the load alike",
       .advice = "look at the pins and their grooves in the shell; replace pins as a set"},
  };
}

}  // namespace

Kinematics rv_reducer(const std::string& machine, const RvGeometry& geometry,
                      const BearingGeometry& crank_bearing) {
  check(geometry);
  const double i = ratio(geometry);
  const Rates rates{
      .unit = 1 / i, .sun = (i - 1) / i, .crank = geometry.pins / i, .orbit = geometry.lobes / i};
  Kinematics k;
  k.machine = machine;
  k.period_turns = period(geometry);
  k.gear_ratio = i;
  k.orders = order_table(geometry, rates);
  k.meshes = meshes(geometry, rates);
  k.signatures = input_signatures(rates, geometry.planets);
  for (Signature& s : carried_signatures(rates)) k.signatures.push_back(std::move(s));
  if (crank_bearing.rolling_elements > 0) {
    k.bearings.push_back(
        rolling_bearing("crank bearing", crank_bearing, rates.crank, k.signatures.size()));
    for (Signature& s : bearing_signatures(crank_bearing, rates.crank, 0.02)) {
      k.orders.push_back({"crank " + s.component, s.order, {}, s.component, ""});
      if (s.mechanism == "spall") s.load_growth = grows_as_blows;  // it carries the discs' load
      k.signatures.push_back(std::move(s));
    }
  }
  return k;
}

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
        .depth_limit = 0.07,
        .limit_why = "assumed: a sound race leaves no periodic blows; what noise leaves is less",
        .advice = "replace the bearing; look for the cause in load, fit and grease"};
  };
  Signature cage = signature("bearing_cage", o.cage, {});
  cage.mechanism = "wear";
  cage.depth_limit = 0.3;
  cage.limit_why =
      "assumed: rolling elements of unequal size shift the load once per cage turn, too";
  return {signature("bearing_inner", o.inner, {race_order}),
          signature("bearing_outer", o.outer, {}),
          signature("bearing_ball", o.ball, {o.cage * race_order}), std::move(cage)};
}

}  // namespace rvbench::analysis
