#include "sim/rv_unit.hpp"

#include <catch2/catch.hpp>

using namespace rvbench;
using sim::draw_unit;

TEST_CASE("how grave a fault is changes nothing else of a unit", "[sim]") {
  const sim::RvUnit drawn = draw_unit("planet_tooth", 7);
  const sim::RvUnit own = draw_unit("planet_tooth", 7, 1), half = draw_unit("planet_tooth", 7, 0.5);
  CHECK(own.deviations.planet_bad_tooth_um == 25);  // as the preset has it
  CHECK(half.deviations.planet_bad_tooth_um == 12.5);
  CHECK(drawn.deviations.planet_bad_tooth_um >= 12.5);
  CHECK(drawn.deviations.planet_bad_tooth_um <= 50);
  CHECK(half.deviations.crank_error_um == drawn.deviations.crank_error_um);
  CHECK(half.phases_rad == drawn.phases_rad);
  CHECK(half.noise_level_factor == drawn.noise_level_factor);
  CHECK(half.noise_seed == drawn.noise_seed);
}

TEST_CASE("a fault of no severity is within tolerance, as on a good unit", "[sim]") {
  const sim::RvUnit none = draw_unit("input_shaft", 3, 0), healthy = draw_unit("healthy", 3);
  CHECK(none.deviations.shaft_eccentricity_um == healthy.deviations.shaft_eccentricity_um);
  CHECK(none.deviations.sun_tooth_error_um == healthy.deviations.sun_tooth_error_um);
}
