#include "analysis/evidence/own_lines.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "analysis/evidence/gear_combs.hpp"
#include "analysis/planetary_stage.hpp"
#include "tests/analysis/reducers.hpp"

using namespace rvbench;
using analysis::Kinematics;
using analysis::PartLines;

namespace {

constexpr double carrier_turns = 121;  // of the RV-20E; orders below are in 1/121
constexpr double lattice = 0.99 / carrier_turns;
constexpr int top_line = 9000;

// The lines of a sound RV-20E, written out: 1080 is the tooth mesh, whose planets go round once in
// 121, 1560 the pin pass, which the crank takes round in 39.
std::set<int> sound_by_hand() {
  std::set<int> lines{39, 121, 242};
  for (int h = 1; h <= 9; ++h) {
    for (int m = -2; m <= 2; ++m) {
      for (const int gear : {0, 120, -120, 40, -40}) lines.insert(1080 * h + gear + m);
      for (const int gear : {0, 39, -39, 40, -40}) lines.insert(1560 * h + gear + 39 * m);
      for (const int input : {121, -121, 242, -242}) {
        lines.insert({1080 * h + input + m, 1560 * h + input + 39 * m});
      }
    }
  }
  return lines;
}

bool is_multiple(int line, int turn, int most_beside) {
  for (int m = -most_beside; m <= most_beside; ++m) {
    if ((line - m) % turn == 0 && line - m >= turn) return true;
  }
  return false;
}

std::set<int> lines_of(const PartLines& part) {
  std::set<int> lines;
  for (const analysis::OwnLine& line : part.own) {
    const auto k = static_cast<int>(std::lround(line.order * carrier_turns));
    CHECK(line.order * carrier_turns == Approx(k).margin(1e-6));
    lines.insert(k);
  }
  return lines;
}

// A tooth's contact lasts too long for lines beyond the fourth harmonic of the mesh.
constexpr int of_contact = 4 * 1080;

PartLines part_of(const Kinematics& kinematics, const std::string& component) {
  const auto all = analysis::own_lines(kinematics, lattice, 0, top_line / carrier_turns);
  REQUIRE(all.size() == kinematics.signatures.size());
  return all[test::index_of(kinematics, component)];
}

}  // namespace

TEST_CASE("a sound RV-20E has the lines that its tooth counts give", "[analysis][evidence]") {
  std::set<int> found;
  for (const double order : analysis::sound_lines(test::rv20e(), top_line / carrier_turns)) {
    found.insert(static_cast<int>(std::lround(order * carrier_turns)));
  }
  for (const int line : sound_by_hand()) {
    CAPTURE(line);
    CHECK((line > top_line || found.contains(line)));
  }
}

TEST_CASE(
    "a planet's own lines are multiples of 40/121 that neither the sun, the pins nor a sound "
    "mesh have",
    "[analysis][evidence]") {
  const std::set<int> sound = sound_by_hand();
  std::set<int> expected;
  for (int k = 1; k <= top_line; ++k) {
    if (is_multiple(k, 40, 2) && !is_multiple(k, 120, 2) && !is_multiple(k, 39, 0) &&
        !sound.contains(k) && k <= of_contact + 2) {
      expected.insert(k);
    }
  }
  CHECK(lines_of(part_of(test::rv20e(), "planet_gear")) == expected);
}

TEST_CASE("pins are looked for at multiples of 39/121 that are no planet's",
          "[analysis][evidence]") {
  const std::set<int> sound = sound_by_hand();
  std::set<int> expected;
  for (int k = 39; k <= of_contact; k += 39) {
    if (!is_multiple(k, 40, 2) && !sound.contains(k)) expected.insert(k);
  }
  CHECK(lines_of(part_of(test::rv20e(), "pin_housing")) == expected);
}

TEST_CASE("the lines of a part do not depend on which mesh is listed first",
          "[analysis][evidence]") {
  Kinematics reversed = test::rv20e();
  std::ranges::reverse(reversed.meshes);
  for (const char* part : {"sun_gear", "planet_gear", "pin_housing", "crank"}) {
    CHECK(lines_of(part_of(reversed, part)) == lines_of(part_of(test::rv20e(), part)));
  }
}

TEST_CASE("the sun, all of whose lines a planet may make, is held against the planet's beside",
          "[analysis][evidence]") {
  const PartLines sun = part_of(test::rv20e(), "sun_gear");
  const std::set<int> sound = sound_by_hand();
  std::set<int> expected;
  for (int k = 1; k <= of_contact + 2; ++k) {
    if (is_multiple(k, 120, 2) && !sound.contains(k)) expected.insert(k);
  }
  CHECK(lines_of(sun) == expected);
  for (const analysis::OwnLine& line : sun.own) {
    const auto k = static_cast<int>(std::lround(line.order * carrier_turns));
    CAPTURE(k);
    CHECK(is_multiple(k, 120, 2));
    CHECK_FALSE(sound.contains(k));
    CHECK_FALSE(line.rivals.empty());
    for (const double rival : line.rivals) {
      const auto beside = static_cast<int>(std::lround(rival * carrier_turns));
      CHECK((is_multiple(beside, 40, 2) || is_multiple(beside, 39, 0)));
      CHECK_FALSE(is_multiple(beside, 120, 2));
      CHECK_FALSE(sound.contains(beside));
    }
  }
}

TEST_CASE("a shaft makes its order, its double and the first sidebands of its mesh",
          "[analysis][evidence]") {
  const std::set<int> shaft = lines_of(part_of(test::rv20e(), "input_shaft"));
  for (const int line : {121, 242, 960, 1200, 959, 961, 2040, 2280}) CHECK(shaft.contains(line));
  for (const int line : {1080, 840, 1320, 40}) CHECK_FALSE(shaft.contains(line));
  CHECK_FALSE(shaft.contains(3120));  // 3 x mesh - sun is twice the pin pass
}

TEST_CASE("what rolls has no line of the gears", "[analysis][evidence]") {
  CHECK(part_of(test::rv20e(), "bearing_inner").own.empty());
}

TEST_CASE("every line that a gear may reach is marked, and those between are not",
          "[analysis][evidence]") {
  const double resolution = 1 / (4 * carrier_turns);
  const auto locked = analysis::locked_lines(test::rv20e(), resolution, 2000, 1.5);
  for (std::size_t i = 0; i + 2 < locked.size(); ++i) CHECK(locked[i] == (i % 4 != 2));
}

TEST_CASE("phases are read as far as a blow's contact is short", "[analysis][evidence]") {
  const Kinematics k = analysis::planetary_stage("stage", {20, 25, 70, 3}, {});
  const auto all = analysis::own_lines(k, lattice, 0, 300);
  const std::size_t ring = test::index_of(k, "ring_gear");
  REQUIRE_FALSE(all[ring].turn_lines.empty());
  const double highest = all[ring].turn_lines.back() * k.signatures[ring].turn;
  const double mesh = 70.0 * 20 / 90;  // teeth of the ring times turns of the carrier
  CHECK(highest <= 4 * mesh);
  CHECK(highest > 3 * mesh);
}
