#include "analysis/indicators/order_bands.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/gear_train.hpp"
#include "analysis/rv_reducer.hpp"

using namespace rvbench::analysis;

TEST_CASE("bands of an RV-20E lie side by side, each mesh in one of its own",
          "[analysis][indicators]") {
  const auto bands = order_bands(rv_reducer("RV-20E", {9, 27, 2, 39, 40}, {}));
  REQUIRE(bands.size() == 4);
  CHECK(bands[0].name == "below the meshes");
  CHECK(bands[0].from == 0);
  CHECK(bands[0].to == Approx(1080.0 / 121 - 3.5));
  CHECK(bands[1].name == "sun-planet mesh");
  CHECK(bands[1].to == Approx(1320.0 / 121));  // half-way to the pins
  CHECK(bands[2].name == "pin-lobe pass");
  CHECK(bands[2].to == Approx(1560.0 / 121 + 3.5));
  CHECK(bands[3].name == "above the meshes");
  CHECK(std::isinf(bands[3].to));
  for (std::size_t i = 1; i < bands.size(); ++i) CHECK(bands[i].from == bands[i - 1].to);
}

TEST_CASE("a mesh at a low order leaves no band below it", "[analysis][indicators]") {
  GearTrain train{"slow", {{"shaft", "shaft"}}, {{"mesh", 0, 3, -1, 0, "pinion", ""}}, {}};
  const auto bands = order_bands(gear_train(train));
  REQUIRE(bands.size() == 2);
  CHECK(bands[0].name == "mesh");
  CHECK(bands[0].from == 0);
}

TEST_CASE("a bearing rig has its characteristic orders, and what they strike",
          "[analysis][indicators]") {
  GearTrain train{"rig", {{"shaft", "motor"}}, {}, {{"bearing", 0, {9, 7.94, 39.04, 0}}}};
  const auto bands = order_bands(gear_train(train));
  REQUIRE(bands.size() == 2);
  CHECK(bands[0].to == Approx(4.5 * 4.5 * (1 + 7.94 / 39.04)));  // its inner race is the highest
  CHECK(bands[1].from == bands[0].to);
  CHECK(order_bands({}).empty());
}
