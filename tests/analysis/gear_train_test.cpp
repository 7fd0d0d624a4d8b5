#include "analysis/gear_train.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <stdexcept>

using namespace rvbench::analysis;

namespace {

// Input 20:60, intermediate 15:45, output; a bearing on the intermediate shaft.
GearTrain two_stages() {
  GearTrain train;
  train.machine = "two stages";
  train.shafts = {{"input", "input_shaft"}, {"middle", "middle_shaft"}, {"output", "output_shaft"}};
  train.meshes = {{"first mesh", 0, 20, 1, 60, "first_pinion", "first_wheel"},
                  {"second mesh", 1, 15, 2, 45, "second_pinion", "second_wheel"}};
  train.bearings = {{"middle bearing", 1, {9, 7.94, 39.04, 0}, 0.01}};
  return train;
}

double order_of(const Kinematics& kinematics, const std::string& name) {
  for (const CharacteristicOrder& o : kinematics.orders) {
    if (o.name == name) return o.order;
  }
  FAIL("no order " << name);
  return 0;
}

std::string refusal(const GearTrain& train) {
  try {
    gear_train(train);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("shafts of a gear train turn as their teeth have it", "[analysis][kinematics]") {
  const Kinematics kinematics = gear_train(two_stages());
  CHECK(order_of(kinematics, "input") == 1);
  CHECK(order_of(kinematics, "middle") == Approx(1.0 / 3));
  CHECK(order_of(kinematics, "output") == Approx(1.0 / 9));
  CHECK(order_of(kinematics, "first mesh") == Approx(20));
  CHECK(order_of(kinematics, "second mesh") == Approx(5));
  CHECK(order_of(kinematics, "middle bearing bearing_outer") == Approx(3.5848 / 3).margin(1e-4));
}

TEST_CASE("the meshes may be listed from the output backwards", "[analysis][kinematics]") {
  GearTrain train = two_stages();
  std::swap(train.meshes[0], train.meshes[1]);
  const auto orders = shaft_orders(train);
  REQUIRE(orders.size() == 3);
  CHECK(orders[2] == Approx(1.0 / 9));
}

TEST_CASE("each gear of a train has a signature at its own shaft's order",
          "[analysis][kinematics]") {
  const Kinematics kinematics = gear_train(two_stages());
  const auto order = [&](const std::string& component) {
    const auto found = std::find_if(kinematics.signatures.begin(), kinematics.signatures.end(),
                                    [&](const Signature& s) { return s.component == component; });
    return found == kinematics.signatures.end() ? -1 : found->order;
  };
  CHECK(order("first_pinion") == 1);
  CHECK(order("first_wheel") == Approx(1.0 / 3));
  CHECK(order("second_pinion") == Approx(1.0 / 3));
  CHECK(order("second_wheel") == Approx(1.0 / 9));
  for (const Signature& s : kinematics.signatures) {
    CAPTURE(s.component);
    CHECK(s.depth_limit > 0);
    CHECK_FALSE(s.advice.empty());
    CHECK_FALSE(s.limit_why.empty());
  }
}

TEST_CASE("of several bearings, findings say which one", "[analysis][kinematics]") {
  GearTrain train = two_stages();
  const auto components = [&] {
    std::vector<std::string> names;
    for (const Signature& s : gear_train(train).signatures) {
      if (s.slip > 0) names.push_back(s.component);
    }
    return names;
  };
  CHECK(components() ==
        std::vector<std::string>{"bearing_inner", "bearing_outer", "bearing_ball", "bearing_cage"});
  train.bearings.push_back({"output bearing", 2, {9, 7.94, 39.04, 0}, 0.01});
  const auto names = components();
  REQUIRE(names.size() == 8);
  CHECK(names[0] == "middle bearing bearing_inner");
  CHECK(names[5] == "output bearing bearing_outer");
  CHECK(order_of(gear_train(train), "output bearing bearing_outer") ==
        Approx(3.5848 / 9).margin(1e-4));
}

TEST_CASE("a mesh whose wheel is not known still has its line", "[analysis][kinematics]") {
  GearTrain train;
  train.shafts = {{"pinion shaft", "input_shaft"}};
  train.meshes = {{"pinion mesh", 0, 23, -1, 0, "pinion", ""}};
  CHECK(order_of(gear_train(train), "pinion mesh") == 23);
}

TEST_CASE("each mesh knows its gears, as far as they are known", "[analysis][kinematics]") {
  const Kinematics k = gear_train(two_stages());
  REQUIRE(k.meshes.size() == 2);
  CHECK(k.meshes[1].order == Approx(5));  // 15 teeth at a third of the input's speed
  REQUIRE(k.meshes[1].gears.size() == 2);
  CHECK(k.meshes[1].gears[0].shaft == "middle");
  CHECK(k.meshes[1].gears[1].order == Approx(1.0 / 9));
  CHECK(k.meshes[1].gears[1].teeth == 45);
  GearTrain pinion;
  pinion.shafts = {{"pinion shaft", "pinion"}};
  pinion.meshes = {{"pinion mesh", 0, 23, -1, 0, "pinion", ""}};
  CHECK(gear_train(pinion).meshes.at(0).gears.size() == 1);
}

TEST_CASE("a gear train that cannot turn is refused by name", "[analysis][kinematics][errors]") {
  using Catch::Matchers::Contains;
  GearTrain train = two_stages();
  CHECK(refusal(train) == "accepted");
  SECTION("no shaft at all") {
    CHECK_THAT(refusal({}), Contains("shaft"));
    CHECK_THROWS_AS(shaft_orders({}), std::invalid_argument);
  }
  SECTION("a wheel without teeth") {
    train.meshes[1].driven_teeth = 0;
    CHECK_THAT(refusal(train), Contains("second mesh"));
  }
  SECTION("a mesh with a shaft that is not there") {
    train.meshes[0].driven = 3;
    CHECK_THAT(refusal(train), Contains("first mesh"));
    CHECK_THROWS_AS(shaft_orders(train), std::invalid_argument);
  }
  SECTION("a bearing on a shaft that is not there") {
    train.bearings[0].shaft = -1;
    CHECK_THAT(refusal(train), Contains("middle bearing"));
  }
  SECTION("a shaft that nothing drives") {
    train.meshes.pop_back();
    CHECK_THAT(refusal(train), Contains("output"));
  }
}
