#include <catch2/catch.hpp>
#include <random>

#include "analysis/gear_train.hpp"
#include "analysis/rv_reducer.hpp"
#include "analysis/spectral_lines.hpp"

using namespace rvbench::analysis;
using Catch::Matchers::Contains;

namespace {

constexpr double near = 0.6 / 121 / 16;  // 0.6 lines of 16 output turns

Kinematics rv20e() { return rv_reducer("RV-20E", {9, 27, 2, 39, 40}, {}); }

Kinematics pinion() {
  GearTrain train;
  train.shafts = {{"pinion shaft", "input_shaft"}};
  train.meshes = {{"pinion mesh", 0, 23, -1, 0, "pinion", ""}};
  return gear_train(train);
}

SpectralLine line(double order, double amplitude) { return {order, 30 * order, amplitude, 0, ""}; }

}  // namespace

TEST_CASE("orders are called what the parts do", "[analysis][lines]") {
  const Kinematics k = rv20e();
  CHECK(meaning_of(1, near, k) == "input shaft");
  CHECK(meaning_of(2, near, k) == "input shaft x2");
  CHECK(meaning_of(1080.0 / 121, near, k) == "sun-planet mesh");
  CHECK(meaning_of(3240.0 / 121, near, k) == "sun-planet mesh x3");
  CHECK(meaning_of(1560.0 / 121, near, k) == "pin-lobe pass");
  CHECK(meaning_of(39.0 / 121, near, k) == "crank in housing");
  CHECK(meaning_of(120.0 / 121, near, k) == "sun against carrier");
  CHECK_THAT(meaning_of(1081.0 / 121, near, k), Contains("sun-planet mesh + "));
  CHECK_THAT(meaning_of(1080.0 / 121 - 1, near, k), Contains("sun-planet mesh - "));
  CHECK(meaning_of(3229.0 / 121, near, k) != "");  // no part's, but the gear train's
}

TEST_CASE("an order between the gear train's lines has no meaning", "[analysis][lines]") {
  const Kinematics k = rv20e();
  for (const double order : {0.5 / 121, 4.5 / 121, 120.5 / 121, 1080.4 / 121, 3000.5 / 121}) {
    CAPTURE(order);
    CHECK(meaning_of(order, near, k) == "");
  }
}

TEST_CASE("random orders are explained no oftener than chance has it", "[analysis][lines]") {
  // Every ideal line is k/121, so a tolerance of 0.6 lines of 16 turns takes 2·0.6/16 of the axis.
  const Kinematics k = rv20e();
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> anywhere(0.1, 30);
  const int draws = 4000;
  int explained = 0;
  for (int i = 0; i < draws; ++i) explained += meaning_of(anywhere(generator), near, k) != "";
  const double chance = 2 * 0.6 / 16;
  CHECK(explained <= draws * chance + 4 * std::sqrt(draws * chance * (1 - chance)));
}

TEST_CASE("an order too uncertain to tell k/121 from (k + 1)/121 is not called the gear train's",
          "[analysis][lines]") {
  CHECK_THAT(meaning_of(3229.0 / 121, 0.1 / 121, rv20e()), Contains("3229/121"));
  CHECK(meaning_of(3229.0 / 121, 0.5 / 121, rv20e()) == "");
}

TEST_CASE("a machine that does not repeat leaves orders beside its parts' unexplained",
          "[analysis][lines]") {
  CHECK(meaning_of(23, 0.01, pinion()) == "pinion mesh");
  CHECK(meaning_of(24, 0.01, pinion()) != "");
  CHECK(meaning_of(23.4, 0.01, pinion()) == "");
  CHECK(meaning_of(3.585, 0.01, pinion()) == "");
}

TEST_CASE("a rolling element that slips may be what is near its order, and no more",
          "[analysis][lines]") {
  // Of the bearing's own order 5.4152 (9 balls of 7.94 mm on 39.04 mm) the slip is 2 %.
  GearTrain train;
  train.shafts = {{"motor shaft", "input_shaft"}};
  train.bearings = {{"drive end", 0, {9, 7.94, 39.04, 0}, 0.02}};
  const Kinematics k = gear_train(train);
  const double inner = 9.0 / 2 * (1 + 7.94 / 39.04);
  const std::string word = may_be(0.997 * inner, k);
  CHECK_THAT(word, Contains("may be ") && Contains("inner"));
  CHECK(may_be(1.015 * 2 * inner, k) == word + " x2");
  CHECK_FALSE(is_characteristic({0.997 * inner, 0, 0, 0, word}, k));
  CHECK(meaning_of(0.997 * inner, near, k) == "");
  CHECK(may_be(1.03 * inner, k) == "");
  CHECK(may_be(7 * inner, k) == "");
  CHECK(may_be(0.997 * inner, rv20e()) == "");
}

TEST_CASE("unexplained harmonics are one family", "[analysis][lines]") {
  const auto found = families({line(3.1, 5), line(6.2, 4), line(9.3, 1), line(7.77, 2)}, rv20e());
  REQUIRE(found.size() == 2);
  CHECK(found[0].order == 3.1);
  CHECK(found[0].amplitude == 5);
  CHECK_THAT(found[0].meaning, Contains("x1") && Contains("x2") && Contains("x3"));
  CHECK(found[1].order == 7.77);
  CHECK(found[1].meaning == "");
}

TEST_CASE("unexplained sidebands of a mesh belong to the order that spaces them",
          "[analysis][lines]") {
  const auto found = families({line(23 - 0.39, 5), line(23 + 0.39, 4), line(0.39, 1)}, pinion());
  REQUIRE(found.size() == 1);
  CHECK(found[0].order == 0.39);
  CHECK(found[0].amplitude == 5);
  CHECK_THAT(found[0].meaning, Contains("pinion mesh - 1x") && Contains("pinion mesh + 1x"));
}

TEST_CASE("a family's strongest line speaks for its amplitude, families come by it",
          "[analysis][lines]") {
  const auto found = families({line(9.9, 7), line(2.2, 6), line(4.4, 6.5)}, rv20e());
  REQUIRE(found.size() == 2);
  CHECK(found[0].order == 9.9);
  CHECK(found[1].order == 2.2);
  CHECK(found[1].amplitude == 6.5);
  CHECK(families({}, rv20e()).empty());
}
