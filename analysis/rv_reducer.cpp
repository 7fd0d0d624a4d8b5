#include "analysis/rv_reducer.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "analysis/bearing_signatures.hpp"
#include "analysis/planetary_stage.hpp"
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

// A bad crank, planet or pin: what goes round in the carrier.
std::vector<Signature> carried_signatures(const Rates& r, Signature planet) {
  planet.table4_item = "Planetary gear rotation frequency";
  planet.first_harmonic = 2;  // once per crank turn is what eccentricity does, too
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
      std::move(planet),
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
       .depth_limit = 0.04,
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
  const SunStage stage{.planets = geometry.planets,
                       .sun_teeth = geometry.sun_teeth,
                       .sun = rates.sun,
                       .planet = rates.crank,
                       .carrier = rates.unit};
  k.signatures = input_signatures(stage);
  k.signatures[0].table4_item = "Drive shaft frequency";
  k.signatures[1].table4_item = "Planetary gear meshing frequency";
  for (Signature& s : carried_signatures(rates, planet_signature(stage))) {
    k.signatures.push_back(std::move(s));
  }
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

}  // namespace rvbench::analysis
