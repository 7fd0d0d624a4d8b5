#include <catch2/catch.hpp>
#include <stdexcept>

#include "analysis/bearing_signatures.hpp"
#include "analysis/kinematics.hpp"

using rvbench::analysis::bearing_orders;
using rvbench::analysis::bearing_signatures;
using rvbench::analysis::BearingGeometry;
using rvbench::analysis::BearingOrders;
using rvbench::analysis::Signature;

namespace {

struct Published {
  const char* bearing;
  BearingGeometry geometry;
  BearingOrders orders;
  double last_digit;
};

}  // namespace

TEST_CASE("bearing orders are those that test rigs publish", "[analysis][kinematics][literature]") {
  const auto known = GENERATE(
      // Case Western Reserve University bearing data center: drive end and fan end. Its "rolling
      // element" order is that of a ball defect, which strikes both races: 2·BSF.
      Published{"SKF 6205-2RS", {9, 7.94, 39.04, 0}, {0.39828, 3.5848, 5.4152, 4.7135}, 2e-4},
      Published{"SKF 6203-2RS", {8, 6.746, 28.499, 0}, {0.3817, 3.0530, 4.9469, 3.9874}, 5e-4},
      // Lee et al., IMS bearing data set: 236.4, 296.9 and 14.78 Hz at 2000 rpm, and the rollers
      // turn at 139.9 Hz.
      Published{"Rexnord ZA-2115",
                {16, 8.407, 71.501, 15.17},
                {14.78 / (2000 / 60.0), 236.4 / (2000 / 60.0), 296.9 / (2000 / 60.0),
                 2 * 139.9 / (2000 / 60.0)},
                5e-3});
  CAPTURE(known.bearing);
  const BearingOrders orders = bearing_orders(known.geometry);
  CHECK(orders.cage == Approx(known.orders.cage).margin(known.last_digit));
  CHECK(orders.outer == Approx(known.orders.outer).margin(known.last_digit));
  CHECK(orders.inner == Approx(known.orders.inner).margin(known.last_digit));
  CHECK(orders.ball == Approx(known.orders.ball).margin(known.last_digit));
}

TEST_CASE("every ball passes each race once per cage turn against it", "[analysis][kinematics]") {
  const auto contact_deg = GENERATE(0.0, 15.0, 40.0);
  const BearingOrders orders = bearing_orders({11, 5, 26, contact_deg});
  CHECK(orders.outer == Approx(11 * orders.cage));
  CHECK(orders.inner == Approx(11 * (1 - orders.cage)));
  // Rolling on the outer race, whose raceway has the diameter D + d·cos α, without slip.
  const double ball_turns =
      orders.cage * (26 + 5 * std::cos(contact_deg * std::acos(-1.0) / 180)) / 5;
  CHECK(orders.ball == Approx(2 * ball_turns));
}

TEST_CASE("a bearing is known by its races as well as by its size", "[analysis][kinematics]") {
  const BearingOrders sized = bearing_orders({16, 8.407, 71.501, 15.17});
  const BearingOrders raced =
      bearing_orders(rvbench::analysis::bearing_of_races(sized.outer, sized.inner, 15.17));
  CHECK(raced.outer == Approx(sized.outer));
  CHECK(raced.inner == Approx(sized.inner));
  CHECK(raced.cage == Approx(sized.cage));
}

TEST_CASE("a bearing that cannot be built is refused", "[analysis][kinematics][errors]") {
  const auto geometry = GENERATE(
      BearingGeometry{1, 5, 26, 0}, BearingGeometry{9, 0, 26, 0}, BearingGeometry{9, -5, 26, 0},
      BearingGeometry{9, 26, 26, 0}, BearingGeometry{9, 5, 26, 90}, BearingGeometry{9, 5, 26, -1},
      BearingGeometry{9, std::nan(""), 26, 0}, BearingGeometry{9, 5, 26, std::nan("")});
  CHECK_THROWS_AS(bearing_orders(geometry), std::invalid_argument);
}

TEST_CASE("a race that turns slower is struck as much more seldom", "[analysis][kinematics]") {
  const BearingGeometry bearing{9, 7.94, 39.04, 0};
  const BearingOrders orders = bearing_orders(bearing);
  const auto signatures = bearing_signatures(bearing, 0.25, 0.02);
  REQUIRE(signatures.size() == 4);
  const auto of = [&](const std::string& component) {
    const auto found = std::find_if(signatures.begin(), signatures.end(),
                                    [&](const Signature& s) { return s.component == component; });
    REQUIRE(found != signatures.end());
    return *found;
  };
  CHECK(of("bearing_inner").order == Approx(0.25 * orders.inner));
  CHECK(of("bearing_outer").order == Approx(0.25 * orders.outer));
  CHECK(of("bearing_ball").order == Approx(0.25 * orders.ball));
  CHECK(of("bearing_cage").order == Approx(0.25 * orders.cage));
  // A spall that travels with the race, or the cage, passes the load zone once per turn of it.
  CHECK(of("bearing_inner").sidebands == std::vector<double>{0.25});
  CHECK(of("bearing_ball").sidebands == std::vector<double>{0.25 * orders.cage});
  CHECK(of("bearing_outer").sidebands.empty());
  for (const Signature& s : signatures) CHECK(s.slip == 0.02);
}
