#include "analysis/evidence/kinship.hpp"

#include <catch2/catch.hpp>

#include "analysis/gear_train.hpp"
#include "tests/analysis/reducers.hpp"

using namespace rvbench;
using analysis::Kinematics;
using test::index_of;

namespace {

bool follows(const Kinematics& k, const char* lesser, const char* graver) {
  return analysis::may_follow_from(index_of(k, lesser), index_of(k, graver), k);
}

bool same_lines(const Kinematics& k, const char* a, const char* b) {
  return analysis::have_the_same_lines(k.signatures[index_of(k, a)], k.signatures[index_of(k, b)]);
}

Kinematics two_stages() {
  return analysis::gear_train({"train",
                               {{"in", "in"}, {"middle", "middle"}, {"out", "out"}},
                               {{"first", 0, 20, 1, 50, "pinion_1", "wheel_1"},
                                {"second", 1, 21, 2, 60, "pinion_2", "wheel_2"}},
                               {{"ball", 1, {9, 7.94, 39.04, 0}, 0.02}}});
}

}  // namespace

TEST_CASE("a shaft may follow from bad teeth that turn with it", "[analysis][evidence]") {
  CHECK(follows(test::rv20e(), "input_shaft", "sun_gear"));
  CHECK_FALSE(follows(test::rv20e(), "sun_gear", "input_shaft"));
  CHECK_FALSE(follows(test::rv20e(), "input_shaft", "planet_gear"));
  CHECK(follows(two_stages(), "middle", "wheel_1"));
  CHECK_FALSE(follows(two_stages(), "middle", "pinion_1"));
}

TEST_CASE("parts of one bearing may follow from each other", "[analysis][evidence]") {
  CHECK(follows(test::rv20e(), "bearing_ball", "bearing_inner"));
  CHECK_FALSE(follows(test::rv20e(), "bearing_ball", "sun_gear"));
  CHECK_FALSE(follows(test::rv20e(), "planet_gear", "pin_housing"));
}

TEST_CASE("no line parts two gears of one shaft", "[analysis][evidence]") {
  CHECK(same_lines(two_stages(), "wheel_1", "pinion_2"));
  CHECK_FALSE(same_lines(two_stages(), "pinion_1", "wheel_1"));
  CHECK_FALSE(same_lines(two_stages(), "middle", "pinion_2"));
  CHECK_FALSE(same_lines(test::rv20e(), "sun_gear", "planet_gear"));
}
