#include "analysis/explain/torque_balance.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace rvbench::analysis;

namespace {

// A drive that loses 1.2 N·m per rad/s turns a drag that gains 0.005: the torque between them and
// the speed where they balance, by hand.
constexpr double drive_slope = 1.2, drag_slope = 0.005;

TransducerMeans condition(double torque_Nm, double speed_rad_s, double drive_Nm, double drag_Nm) {
  const double both = drive_slope + drag_slope;
  TransducerMeans means;
  means.response << drag_slope / both, drive_slope / both, 1 / both, -1 / both;
  means.apart = means.response * Eigen::Vector2d(drive_Nm, drag_Nm);
  means.standard_error = {0.002, 0.003};
  means.torque_Nm = torque_Nm;
  means.speed_rad_s = speed_rad_s;
  return means;
}

// 21 conditions that lack drive and drag by laws of load and speed.
template <typename Drive, typename Drag>
std::vector<TransducerMeans> campaign(std::uint64_t seed, Drive drive, Drag drag) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<TransducerMeans> all;
  for (const double speed_rad_s : {63.0, 127.0, 190.0}) {
    for (int load = 0; load <= 6; ++load) {
      const double torque_Nm = 0.2 + 0.35 * load;
      all.push_back(condition(torque_Nm, speed_rad_s, drive(torque_Nm, speed_rad_s),
                              drag(torque_Nm, speed_rad_s)));
      for (int i : {0, 1}) all.back().apart[i] += all.back().standard_error[i] * normal(engine);
    }
  }
  return all;
}

double nothing(double, double) { return 0; }

}  // namespace

SCENARIO("a drag that the model lacks is found on the right of the transducer",
         "[analysis][explain][locate]") {
  GIVEN("one that grows with load") {
    const auto found = torque_balances(
        campaign(3, nothing, [](double torque_Nm, double) { return 0.01 + 0.04 * torque_Nm; }));
    REQUIRE(found.size() == 1);
    CHECK(found[0].side == Side::right);
    CHECK(found[0].mean_Nm == Approx(0.01 + 0.04 * 1.25).margin(4 * found[0].standard_error_Nm));
    CHECK(found[0].standard_error_Nm == Approx(0.002 / std::sqrt(21)).epsilon(0.5));
    CHECK(found[0].per_load == Approx(0.04).margin(4 * found[0].per_load_error));
    CHECK(found[0].per_speed == 0);
    CHECK(found[0].least_Nm == Approx(0.018).margin(0.003));
    CHECK(found[0].most_Nm == Approx(0.102).margin(0.003));
    CHECK(law_text(found[0]) == "rises with load");
  }
  GIVEN("one that is always the same") {
    const auto found = torque_balances(campaign(4, nothing, [](double, double) { return 0.02; }));
    REQUIRE(found.size() == 1);
    CHECK(law_text(found[0]) == "the same at all loads and speeds");
  }
}

SCENARIO("a drive weaker than the model's is found on the left, though the torque hardly changes",
         "[analysis][explain][locate]") {
  const auto found = torque_balances(campaign(
      5, [](double, double speed_rad_s) { return -0.001 * speed_rad_s; }, nothing));
  REQUIRE(found.size() == 1);
  CHECK(found[0].side == Side::left);
  CHECK(found[0].per_speed == Approx(-0.001).margin(4 * found[0].per_speed_error));
  CHECK(law_text(found[0]) == "falls with speed");
}

TEST_CASE("noise tells nothing of either side, but for its share", "[analysis][explain][locate]") {
  int told = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    if (!torque_balances(campaign(seed, nothing, nothing)).empty()) ++told;
  }
  CHECK(told <= 21);  // three numbers on two sides at 1 %: 12 expected, 21 in one of a hundred
}

TEST_CASE("too few conditions tell no law", "[analysis][explain][locate]") {
  auto few = campaign(6, nothing, [](double, double) { return 0.5; });
  few.resize(4);
  CHECK(torque_balances(few).empty());
}

TEST_CASE("where both sides answer alike neither is told", "[analysis][explain][locate]") {
  auto all = campaign(7, nothing, [](double, double) { return 0.5; });
  all[3].response.col(1) = -2 * all[3].response.col(0);
  CHECK(torque_balances(all).empty());
}

TEST_CASE("speed alone, at one load, is no law of load", "[analysis][explain][locate]") {
  std::vector<TransducerMeans> unloaded;
  for (const double speed_rad_s : {20.0, 40.0, 63.0, 90.0, 127.0, 190.0}) {
    const double viscous_Nm = 1e-3 * speed_rad_s;
    unloaded.push_back(condition(0.4 + 5e-4 * speed_rad_s, speed_rad_s, 0, viscous_Nm));
  }
  const auto found = torque_balances(unloaded);
  REQUIRE(found.size() == 1);
  CHECK(law_text(found[0]) == "rises with speed");
}
