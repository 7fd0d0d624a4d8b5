#include "bench/order_campaign.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "bench/order_choice.hpp"
#include "bench/order_errors.hpp"
#include "bench/planned_inputs.hpp"
#include "sim/rv_plant.hpp"

using namespace rvbench;
using namespace rvbench::bench;

namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double planned_rpm = 605, supply_Hz = 605.0 / 30;  // two pole pairs
constexpr double bar_Nm = 0.05;

// A record that a motor with this slip speed made: its bars' line, and the first harmonics of the
// output's turn. Written down here: nothing simulated it.
CampaignRecord record_of(double slip_Hz, bool learned_from = true, double rate_Hz = 200) {
  const double speed_Hz = supply_Hz / 2 - slip_Hz;
  const double line_Hz = 2 * (supply_Hz - 2 * speed_Hz);
  const auto count = Eigen::Index(4.5 * 121 / (planned_rpm / 60) * 1.05 * rate_Hz);
  Eigen::VectorXd torque_Nm(count), angle_rad(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double t_s = double(i) / rate_Hz;
    angle_rad[i] = two_pi * speed_Hz * t_s;
    torque_Nm[i] = 1.5 + bar_Nm * std::cos(two_pi * line_Hz * t_s + 0.3);
    for (const int order : {1, 3, 40}) {
      torque_Nm[i] += 0.02 * std::cos(order * angle_rad[i] / 121);
    }
  }
  CampaignRecord record;
  record.condition = record.programme = "605 rpm, 150 %";
  record.learned_from = learned_from;
  record.recording.planned_speed_rpm = planned_rpm;
  record.recording.load_pct = 150;
  record.recording.channels = {{{"input_torque", "N·m", "", not_known}, rate_Hz, 0, torque_Nm},
                               {{"input_angle", "rad", "", not_known}, rate_Hz, 0, angle_rad}};
  return record;
}

OrderCampaign seen_of(std::vector<CampaignRecord> records) {
  Campaign campaign;
  campaign.records = std::move(records);
  const sim::PlantSpec plant = sim::rv20e_bench();
  add_planned_inputs(plant, campaign);
  auto seen = order_campaign(plant, campaign, sim::standard_terms());
  if (auto* refusal = std::get_if<Refusal>(&seen)) {
    for (const auto& fault : refusal->faults) UNSCOPED_INFO(fault.pointer << ": " << fault.message);
    FAIL("refused");
  }
  return std::get<OrderCampaign>(std::move(seen));
}

std::size_t slip_line(const OrderCondition& condition) {
  const auto lines = timed_lines(sim::rv20e_bench(), condition);
  const auto found = std::ranges::find(lines, "motor_torque", &OrderFeature::slip_of);
  REQUIRE(found != lines.end());
  return std::size_t(found - lines.begin());
}

}  // namespace

// 4 % of a slip line at 1.3 Hz are three lines of such a record.
TEST_CASE("each record shows its slip line where its own speed has it", "[bench][orders]") {
  const OrderCampaign seen = seen_of({record_of(0.31), record_of(0.32), record_of(0.335)});
  REQUIRE(seen.conditions.size() == 1);
  const std::size_t line = slip_line(seen.conditions[0]);
  for (const OrderRecord& record : seen.records) {
    CHECK(record.timed[line].amplitude == Approx(bar_Nm).epsilon(0.01));
  }
  THEN("the condition has it at the mean speed") {
    const OrderFeature feature = timed_lines(sim::rv20e_bench(), seen.conditions[0])[line];
    CHECK(feature.frequency_Hz == Approx(4 * (0.31 + 0.32 + 0.335) / 3).epsilon(1e-3));
  }
}

TEST_CASE("a record that is only predicted has no say in what is compared", "[bench][orders]") {
  const auto features_beside = [](double slip_Hz) {
    OrderCampaign seen = seen_of({record_of(0.31), record_of(0.32), record_of(slip_Hz, false)});
    choose_features(sim::rv20e_bench(), seen.records, {}, seen.period_turns, seen.conditions);
    return seen.conditions[0].features;
  };
  const auto beside_one = features_beside(0.315), beside_other = features_beside(0.5);
  REQUIRE(beside_one.size() == beside_other.size());
  for (std::size_t f = 0; f < beside_one.size(); ++f) {
    CHECK(beside_one[f].locked_to == beside_other[f].locked_to);
    CHECK(beside_one[f].order == beside_other[f].order);
    CHECK(beside_one[f].frequency_Hz == beside_other[f].frequency_Hz);
  }
}

TEST_CASE("a record that is only predicted has no say in how sure the others are",
          "[bench][orders]") {
  const auto errors_beside = [](double offset_Nm) {
    CampaignRecord other = record_of(0.31, false);
    other.recording.channels[0].samples.array() += offset_Nm;
    OrderCampaign seen = seen_of({record_of(0.31), record_of(0.31), other});
    choose_features(sim::rv20e_bench(), seen.records, {}, seen.period_turns, seen.conditions);
    for (OrderRecord& record : seen.records) read_features(seen.conditions[0], record);
    const OrderScatter scatter = scatter_of(seen.conditions, 2, seen.records);
    find_errors(seen.conditions, scatter, seen.records);
    return seen.records[0].errors;
  };
  CHECK(errors_beside(0) == errors_beside(10));
}

TEST_CASE("a condition that is only predicted has its slip line at its nominal speed",
          "[bench][orders]") {
  CampaignRecord other = record_of(0.4, false);
  other.recording.load_pct = 75;
  const OrderCampaign seen = seen_of({record_of(0.31), other});
  REQUIRE(seen.conditions.size() == 2);
  CHECK(seen.conditions[1].speed_share == 1);
  CHECK(seen.records[1].timed[slip_line(seen.conditions[1])].amplitude ==
        Approx(bar_Nm).epsilon(0.01));
}

// Twice the supply's 20.2 Hz are 40.3 Hz: order 4.1, between two lines of the period.
TEST_CASE("what follows time does not leak into what goes round", "[bench][orders]") {
  CampaignRecord record = record_of(0.31);
  Channel& torque = record.recording.channels[0];
  for (Eigen::Index i = 0; i < torque.samples.size(); ++i) {
    torque.samples[i] += std::cos(two_pi * 2 * supply_Hz * double(i) / torque.rate_Hz);
  }
  const OrderCampaign seen = seen_of({record});
  const OrderRecord& shown = seen.records[0];
  const analysis::PeriodLines& lines = shown.measured.outputs[0];
  const double at = 121 * 2 * supply_Hz / shown.measured.speed_Hz;
  for (const int beside : {-3, -2, 2, 3}) {
    CHECK(lines.amplitude[Eigen::Index(std::lround(at)) + beside] < 1e-4);
  }
  CHECK(lines.amplitude[40] == Approx(0.02).epsilon(0.01));
}

TEST_CASE("no line is surer than a measuring chain is linear", "[bench][orders]") {
  OrderCampaign seen = seen_of({record_of(0.31), record_of(0.31)});
  OrderCondition& condition = seen.conditions[0];
  condition.features = {{analysis::LockedTo::shaft, 0, 77, 0}};  // where there is nothing
  for (OrderRecord& record : seen.records) {
    record.timed.clear();
    read_features(condition, record);
    record.noise.setZero();
  }
  find_errors(seen.conditions, scatter_of(seen.conditions, 2, seen.records), seen.records);
  // What both repeats show alike, they do not tell better than one.
  CHECK(seen.records[0].errors[0] == Approx(std::sqrt(2) * 1e-4 * 0.02).epsilon(0.1));
}

// Between the supply's second harmonic and the strongest line that goes round.
TEST_CASE("where what follows time modulates what goes round, nothing is compared",
          "[bench][orders]") {
  constexpr double fast_Hz = 500;  // shows the meshes
  const OrderCampaign plain = seen_of({record_of(0.31, true, fast_Hz)});
  const double period_Hz = plain.records[0].measured.speed_Hz / plain.period_turns;
  const Eigen::VectorXd lines = plain.conditions[0].nominal.outputs[0].shaft_lines.cwiseAbs();
  Eigen::Index strongest = 0;  // but for the mean
  REQUIRE(lines.tail(lines.size() - 1).maxCoeff() > 0);
  lines.tail(lines.size() - 1).maxCoeff(&strongest);
  const double difference = double(strongest + 1) - 2 * supply_Hz / period_Hz;
  const auto between = static_cast<int>(std::lround(std::abs(difference)));
  const std::vector<int> added{between, between + 31};
  std::vector<CampaignRecord> records{record_of(0.31, true, fast_Hz),
                                      record_of(0.31, true, fast_Hz)};
  for (CampaignRecord& record : records) {
    Eigen::VectorXd& torque_Nm = record.recording.channels[0].samples;
    const Eigen::VectorXd& angle_rad = record.recording.channels[1].samples;
    for (const int order : added)
      torque_Nm.array() += 0.02 * (order * angle_rad.array() / 121).cos();
  }
  OrderCampaign seen = seen_of(std::move(records));
  choose_features(sim::rv20e_bench(), seen.records, {}, seen.period_turns, seen.conditions);
  const auto is_compared = [&](int order) {
    return std::ranges::any_of(seen.conditions[0].features, [&](const OrderFeature& feature) {
      return feature.locked_to == analysis::LockedTo::shaft && feature.order == order;
    });
  };
  CHECK(!is_compared(between));
  CHECK(is_compared(between + 31));
}
