#include "analysis/planetary_stage.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>

using namespace rvbench::analysis;

namespace {

// Sun of 20 teeth, planets of 20, ring of 60: i = 4.
constexpr PlanetaryGeometry stage{20, 20, 60, 3};

const Signature& part(const Kinematics& kinematics, const std::string& component) {
  const auto found = std::ranges::find(kinematics.signatures, component, &Signature::component);
  REQUIRE(found != kinematics.signatures.end());
  return *found;
}

double shaft_limit(int sun_teeth, int planets) {
  const Kinematics k = planetary_stage("P", {sun_teeth, 30, sun_teeth + 60, planets}, {});
  return part(k, "input_shaft").depth_limit;
}

}  // namespace

TEST_CASE("a planetary stage's orders, counted tooth by tooth", "[analysis][kinematics]") {
  // Four turns of the sun are one of the carrier, which three turns of it pass. In these the sun's
  // 20 teeth pass three times, and each planet turns three times on its pin.
  const Kinematics k = planetary_stage("P", stage, {});
  CHECK(k.gear_ratio == 4);
  CHECK(part(k, "sun_gear").turn == Approx(3.0 / 4));
  CHECK(part(k, "planet_gear").turn == Approx(3.0 / 4));
  CHECK(part(k, "ring_gear").turn == Approx(3.0 / 4));  // three planets pass it
  REQUIRE(k.meshes.size() == 1);
  CHECK(k.meshes[0].order == Approx(15));
  CHECK(k.meshes[0].path_order == Approx(1.0 / 4));
  for (const MeshingGear& gear : k.meshes[0].gears) {
    CAPTURE(gear.shaft);
    CHECK(gear.teeth * gear.order == Approx(15));
  }
}

TEST_CASE("a planet's bearing rolls at the planet's turn on its pin", "[analysis][kinematics]") {
  const Kinematics k = planetary_stage("P", stage, {9, 8, 40, 0, true});
  CHECK(part(k, "bearing_outer").order == Approx(3.0 / 4 * 9 * 0.5 * (1 - 0.2)));
  // The pin stands under the load, and what turns passes it once per turn.
  CHECK(part(k, "bearing_inner").sidebands.empty());
  REQUIRE(part(k, "bearing_outer").sidebands.size() == 1);
  CHECK(part(k, "bearing_outer").sidebands[0] == Approx(3.0 / 4));
  CHECK(part(k, "bearing_cage").order == Approx(3.0 / 4 * 0.5 * (1 + 0.2)));
}

TEST_CASE("a sound shaft may swing the more, the better its planets cancel their mesh",
          "[analysis][kinematics]") {
  // Three planets cancel the mesh unless the sun's teeth are a multiple of 3. With 19 or 20 teeth
  // the mesh line's neighbour, a turn of the sun away, comes in phase.
  CHECK(shaft_limit(19, 3) > shaft_limit(18, 3));
  CHECK(shaft_limit(20, 3) > shaft_limit(18, 3));
  // Of four planets and 18 teeth neither comes in phase.
  CHECK(shaft_limit(18, 4) > shaft_limit(20, 4));
  CHECK(shaft_limit(18, 4) < shaft_limit(19, 4));
}

TEST_CASE("a stage that cannot be built is refused", "[analysis][kinematics][errors]") {
  const auto geometry = GENERATE(PlanetaryGeometry{0, 20, 60, 3}, PlanetaryGeometry{20, -1, 60, 3},
                                 PlanetaryGeometry{20, 20, 0, 3}, PlanetaryGeometry{20, 20, 60, 0},
                                 PlanetaryGeometry{20, 20, 65, 3});
  CHECK_THROWS_AS(planetary_stage("P", geometry, {}), std::invalid_argument);
}
