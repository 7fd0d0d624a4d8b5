#include "bench/order_between.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "bench/planned_inputs.hpp"
#include "sim/rv_plant.hpp"

using namespace rvbench;
using namespace rvbench::bench;

namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double rate_Hz = 200, speed_Hz = 9.8;
constexpr double cage_order = 0.3917;  // 47.4 in a period of 121 turns

// A record of noise, of what repeats with the machine, and of a cage. Nothing simulated it.
CampaignRecord record_of(double load_pct, double cage_Nm, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> noise(0, 0.002);
  const auto count = Eigen::Index(4.5 * 121 / speed_Hz * rate_Hz);
  Eigen::VectorXd torque_Nm(count), angle_rad(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    angle_rad[i] = two_pi * speed_Hz * double(i) / rate_Hz;
    torque_Nm[i] = 1.5 + noise(engine) + cage_Nm * std::cos(cage_order * angle_rad[i]) +
                   0.02 * std::cos(40 * angle_rad[i] / 121) + 0.05 * std::cos(angle_rad[i]);
  }
  CampaignRecord record;
  record.condition = record.programme = load_pct > 0 ? "605 rpm, 150 %" : "605 rpm, 0 %";
  record.speed = "605 rpm";
  record.load = load_pct > 0 ? "150 %" : "0 %";
  record.recording.planned_speed_rpm = 605;
  record.recording.load_pct = load_pct;
  record.recording.channels = {{{"input_torque", "N·m", "", not_known}, rate_Hz, 0, torque_Nm},
                               {{"input_angle", "rad", "", not_known}, rate_Hz, 0, angle_rad}};
  return record;
}

std::vector<analysis::ResidualCell> cells_of(double cage_Nm) {
  Campaign campaign;
  for (const double load_pct : {0.0, 150.0}) {
    for (std::uint64_t repeat = 1; repeat <= 3; ++repeat) {
      const double shown_Nm = load_pct > 0 ? cage_Nm : 0;
      campaign.records.push_back(
          record_of(load_pct, shown_Nm, 10 * std::uint64_t(load_pct) + repeat));
    }
  }
  const sim::PlantSpec plant = sim::rv20e_bench();
  add_planned_inputs(plant, campaign);
  auto seen = order_campaign(plant, campaign, sim::standard_terms());
  REQUIRE(std::holds_alternative<OrderCampaign>(seen));
  return cells_between_orders(plant, std::get<OrderCampaign>(seen));
}

}  // namespace

TEST_CASE("a cage that slips is told by its order, under all conditions", "[bench][orders]") {
  const auto cells = cells_of(0.001);
  REQUIRE(cells.size() == 2);
  for (const analysis::ResidualCell& cell : cells) {
    CHECK(cell.channel == "input_torque");
    CHECK(cell.unit == "N·m");
    CHECK(cell.locked_to == analysis::LockedTo::shaft);
    CHECK(cell.place == Approx(cage_order).margin(0.5 / 121));
    CHECK(cell.is_new);
  }
  CHECK(cells[0].condition == "605 rpm, 0 %");
  CHECK(std::abs(cells[0].apart) < 5 * cells[0].standard_error);
  CHECK(cells[1].load == "150 %");
  // 0.4 of a line beside the middle, a Hann window passes 0.9.
  CHECK(cells[1].apart == Approx(0.9 * 0.001).epsilon(0.1));
  CHECK(cells[1].apart > 10 * cells[1].standard_error);
}

TEST_CASE("a machine without one shows none, strong as its own lines may be", "[bench][orders]") {
  CHECK(cells_of(0).empty());
}
