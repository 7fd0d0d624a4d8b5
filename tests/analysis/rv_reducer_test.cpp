#include "analysis/rv_reducer.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>

#include "analysis/table4.hpp"

using namespace rvbench::analysis;

namespace {

constexpr RvGeometry rv20e{9, 27, 2, 39, 40};

double order_of(const Kinematics& kinematics, const std::string& name) {
  for (const CharacteristicOrder& o : kinematics.orders) {
    if (o.name == name) return o.order;
  }
  FAIL("no order " << name);
  return 0;
}

std::string fraction_of(const Kinematics& kinematics, const std::string& name) {
  for (const CharacteristicOrder& o : kinematics.orders) {
    if (o.name == name) return o.fraction;
  }
  return "no such order";
}

}  // namespace

TEST_CASE("the RV-20E's orders, counted tooth by tooth", "[analysis][kinematics]") {
  const Kinematics k = rv_reducer("RV-20E", rv20e, {});
  CHECK(k.period_turns == 121);
  // One carrier turn: the sun passes it 120 times; each crank, with 39 lobes walking over 40 pins,
  // turns 40 times against it, and 39 times in the housing.
  CHECK(order_of(k, "sun against carrier") == Approx(120.0 / 121));
  CHECK(order_of(k, "planet and crank against carrier") == Approx(40.0 / 121));
  CHECK(order_of(k, "crank in housing") == Approx(39.0 / 121));
  // The same teeth pass, seen from the sun and from the planet.
  CHECK(order_of(k, "sun-planet mesh") == Approx(9 * 120.0 / 121));
  CHECK(order_of(k, "sun-planet mesh") == Approx(27 * 40.0 / 121));
  CHECK(order_of(k, "pin-lobe pass") == Approx(1560.0 / 121));
  CHECK(order_of(k, "pin strike, both discs") == Approx(78.0 / 121));
  CHECK(order_of(k, "planet pass") == Approx(2.0 / 121));
  CHECK(fraction_of(k, "sun-planet mesh") == "1080/121");
  CHECK(fraction_of(k, "input shaft") == "1");
}

TEST_CASE("ratios of the maker's catalogue follow from their teeth",
          "[analysis][kinematics][literature]") {
  // Nabtesco RV-E series, RV-20E: ratios 57, 81, 105, 121, 141, 161, all on 40 pins.
  struct Stage {
    int sun, planet;
    double ratio;
  };
  const auto stage = GENERATE(Stage{20, 28, 57}, Stage{12, 24, 81}, Stage{10, 26, 105},
                              Stage{9, 27, 121}, Stage{8, 28, 141}, Stage{6, 24, 161});
  const Kinematics k = rv_reducer("RV-20E", {stage.sun, stage.planet, 2, 39, 40}, {});
  CHECK(k.period_turns == Approx(stage.ratio));
  CHECK(order_of(k, "carrier and cycloid disc") == Approx(1 / stage.ratio));
  CHECK(order_of(k, "sun-planet mesh") ==
        Approx(stage.planet * order_of(k, "planet and crank against carrier")));
}

TEST_CASE("every gear line of an RV reducer repeats with its output turn",
          "[analysis][kinematics]") {
  const auto planets = GENERATE(2, 3);
  const Kinematics k = rv_reducer("RV-20E", {9, 27, planets, 39, 40}, {});
  for (const CharacteristicOrder& o : k.orders) {
    CAPTURE(o.name);
    CHECK(o.order * 121 == Approx(std::round(o.order * 121)).epsilon(1e-12));
    CHECK(o.fraction.empty() == false);
  }
  CHECK(fraction_of(k, "planet pass") == std::to_string(planets) + "/121");
}

TEST_CASE("a reducer of i = 68.5 stands as before after two output turns",
          "[analysis][kinematics]") {
  const Kinematics k = rv_reducer("odd", {16, 27, 2, 39, 40}, {});
  CHECK(k.gear_ratio == Approx(68.5));
  CHECK(k.period_turns == 137);
  CHECK(fraction_of(k, "sun against carrier") == "135/137");
  CHECK(fraction_of(k, "crank in housing") == "78/137");
  for (const CharacteristicOrder& o : k.orders) {
    CAPTURE(o.name);
    CHECK(o.order * k.period_turns == Approx(std::round(o.order * k.period_turns)));
  }
}

TEST_CASE("the crank's bearings stay clear of the gear lines", "[analysis][kinematics]") {
  const Kinematics k = rv_reducer("RV-20E", rv20e, {11, 5, 26, 0});
  int bearings = 0;
  for (const CharacteristicOrder& o : k.orders) {
    if (o.component.rfind("bearing_", 0) != 0) continue;
    ++bearings;
    CAPTURE(o.name);
    CHECK(o.fraction.empty());
  }
  CHECK(bearings == 4);
  CHECK(order_of(k, "crank bearing_outer") == Approx(5.5 * (1 - 5.0 / 26) * 40 / 121));
}

TEST_CASE("each signature says what its limit is for and what to do", "[analysis][kinematics]") {
  const Kinematics k = rv_reducer("RV-20E", rv20e, {11, 5, 26, 0});
  for (const std::string component : {"input_shaft", "sun_gear", "crank", "planet_gear",
                                      "pin_housing", "bearing_inner", "bearing_outer"}) {
    const auto found = std::find_if(k.signatures.begin(), k.signatures.end(),
                                    [&](const Signature& s) { return s.component == component; });
    CAPTURE(component);
    REQUIRE(found != k.signatures.end());
    CHECK(found->depth_limit > 0);
    CHECK_FALSE(found->limit_why.empty());
    CHECK_FALSE(found->advice.empty());
    CHECK(found->first_harmonic >= 1);
    CHECK(found->harmonics >= found->first_harmonic);
  }
}

TEST_CASE("tooth counts that do not mesh are refused", "[analysis][kinematics][errors]") {
  const auto [geometry, wrong] = GENERATE(values<std::pair<RvGeometry, std::string>>({
      {{0, 27, 2, 39, 40}, "sun_teeth is 0"},
      {{9, -1, 2, 39, 40}, "planet_teeth is -1"},
      {{9, 27, 0, 39, 40}, "planets is 0"},
      {{9, 27, 2, 0, 1}, "lobes is 0"},
      {{9, 27, 2, 39, 39}, "pins are 39, must be one more than lobes, 39"},
      {{9, 27, 2, 40, 39}, "pins are 39, must be one more than lobes, 40"},
  }));
  CHECK_THROWS_WITH(rv_reducer("none", geometry, {}), Catch::Contains("rv_reducer: " + wrong));
}

TEST_CASE("the derived orders account for every row of the published Table 4",
          "[analysis][kinematics][literature]") {
  // Its speeds are up to 3.1 % below nominal, its digits end at 0.1 Hz.
  const Kinematics k = rv_reducer("RV-20E", rv20e, {});
  for (const Table4Row& row : table4()) {
    const auto named =
        std::find_if(k.orders.begin(), k.orders.end(),
                     [&](const CharacteristicOrder& o) { return o.table4_item == row.item; });
    CAPTURE(std::string(row.item));
    REQUIRE(named != k.orders.end());
    for (std::size_t i = 0; i < table4_speeds_rpm.size(); ++i) {
      const double nominal_Hz = named->order * table4_speeds_rpm[i] / 60;
      CHECK(row.frequency_Hz[i] <= nominal_Hz + 0.05);
      CHECK(row.frequency_Hz[i] >= nominal_Hz * (1 - 0.031) - 0.05);
    }
  }
}

TEST_CASE("every Table 4 row that a signature names is printed there", "[analysis][kinematics]") {
  const Kinematics k = rv_reducer("RV-20E", rv20e, {11, 5, 26, 0});
  for (const Signature& s : k.signatures) {
    if (s.table4_item.empty()) continue;
    CAPTURE(s.component, s.table4_item);
    CHECK(std::any_of(table4().begin(), table4().end(),
                      [&](const Table4Row& row) { return row.item == s.table4_item; }));
  }
}

TEST_CASE("Table 4 as a catalogue gives back its own Hz at the printed speed",
          "[analysis][kinematics]") {
  const auto column = GENERATE(std::size_t{0}, std::size_t{1}, std::size_t{2});
  const auto stray = GENERATE(0.97, 1.0, 1.03);
  const double speed_rpm = table4_speeds_rpm[column];
  const Kinematics k = published_table4(stray * speed_rpm);
  REQUIRE(k.orders.size() == table4().size());
  for (std::size_t i = 0; i < k.orders.size(); ++i) {
    CHECK(k.orders[i].order * speed_rpm / 60 == Approx(table4()[i].frequency_Hz[column]));
  }
  for (const Signature& s : k.signatures) {
    CAPTURE(s.table4_item);
    CHECK(s.order * speed_rpm / 60 >= 1);
    CHECK(s.tolerance > 0);  // half of the last printed digit
    CHECK(s.tolerance * s.order * speed_rpm / 60 <= 0.051);
    CHECK(s.slip == 0);  // none of its rows is of a part that rolls
  }
}

TEST_CASE("teeth of each gear of a mesh pass at the mesh's order", "[analysis][kinematics]") {
  const Kinematics k = rv_reducer("RV-20E", rv20e, {});
  REQUIRE(k.meshes.size() == 2);
  for (const GearMesh& mesh : k.meshes) {
    CAPTURE(mesh.name);
    CHECK(mesh.order == Approx(order_of(k, mesh.name)));
    REQUIRE(mesh.gears.size() == 2);
    for (const MeshingGear& gear : mesh.gears) {
      CAPTURE(gear.shaft);
      CHECK(gear.teeth * gear.order == Approx(mesh.order));
    }
  }
  CHECK(k.meshes[0].gears[1].order == Approx(40.0 / 121));  // the planet, against the carrier
}
