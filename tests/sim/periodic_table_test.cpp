#include "sim/periodic_table.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "hal/types/units.hpp"

using namespace rvbench;
using units::two_pi;

TEST_CASE("an empty table is zero everywhere", "[sim]") {
  const sim::PeriodicTable table;
  CHECK(table(0) == 0);
  CHECK(table(-17.3) == 0);
}

TEST_CASE("a table reads cosines at any angle, of any turn and sign", "[sim]") {
  sim::PeriodicTable table;
  table.add_cosine(1, 2, 0.3).add_cosine(40, 0.5, -1);
  for (double angle_rad = -20; angle_rad < 20; angle_rad += 0.0137) {
    // The chord misses the arc by at most (step of phase)²/8 of the amplitude.
    const double chord = 0.5 * std::pow(40 * two_pi / 8192, 2) / 8;
    CHECK(table(angle_rad) ==
          Approx(2 * std::cos(angle_rad + 0.3) + 0.5 * std::cos(40 * angle_rad - 1))
              .margin(1.1 * chord));
  }
}

TEST_CASE("a table knows the harmonics that it is made of", "[sim]") {
  sim::PeriodicTable table;
  CHECK(table.harmonics().empty());
  table.add_cosine(12, 0, 0.3);
  CHECK(table.harmonics().empty());
  table.add_cosine(18, 1, 0.3).add_cosine(12, 1, 0);
  CHECK(table.harmonics() == std::set<int>{12, 18});
}

TEST_CASE("a table takes a bump for the harmonics of its spectrum's two lobes", "[sim]") {
  sim::PeriodicTable table;
  table.add_bump(1, two_pi / 10, 1);
  REQUIRE(table.harmonics().size() == 20);
  CHECK(*table.harmonics().begin() == 1);
  CHECK(*table.harmonics().rbegin() == 20);
}

TEST_CASE("a table has no seam where the turn closes", "[sim]") {
  sim::PeriodicTable table;
  table.add_cosine(3, 1, 0.7);
  for (const int turns : {-2, -1, 0, 1, 7}) {
    const double seam_rad = turns * two_pi;
    CHECK(table(seam_rad - 1e-9) == Approx(table(seam_rad + 1e-9)).epsilon(1e-6));
    CHECK(table(seam_rad) == Approx(std::cos(0.7)).epsilon(1e-6));
  }
  CHECK(table(-1e-300) == Approx(std::cos(0.7)).epsilon(1e-6));  // rounds up to a whole turn
}

TEST_CASE("a bump is a raised cosine of its height and width, wherever it stands", "[sim]") {
  const double centre_rad = GENERATE(0.0, 1.0, 6.2, -2.0);
  sim::PeriodicTable table;
  table.add_bump(centre_rad, 0.4, -3);
  CHECK(table(centre_rad) == Approx(-3).epsilon(1e-3));
  CHECK(table(centre_rad + 0.1) == Approx(-1.5).epsilon(1e-2));
  CHECK(table(centre_rad - 0.1) == Approx(-1.5).epsilon(1e-2));
  CHECK(table(centre_rad + 0.21) == 0);
  CHECK(table(centre_rad - 0.21) == 0);
  CHECK(table(centre_rad + two_pi / 2) == 0);
}
