#include "bench/order_campaign.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "bench/order_choice.hpp"
#include "hal/types/parallel_for.hpp"
#include "hal/types/units.hpp"
#include "sim/named.hpp"

namespace rvbench::bench {
namespace {

int orders_of(const OrderMeasurement& measured, std::size_t output) {
  return std::max(0, static_cast<int>(measured.outputs[output].amplitude.size()) - 1);
}

// Finds the record's condition, or opens one; it shows as many orders as all of its records do.
void sort_in(OrderRecord& record, const Eigen::VectorXd& inputs, std::size_t outputs,
             std::vector<OrderCondition>& conditions) {
  const auto known = std::ranges::find(conditions, inputs, &OrderCondition::inputs);
  record.condition = static_cast<std::size_t>(known - conditions.begin());
  if (known == conditions.end()) {
    conditions.push_back({inputs,
                          {},
                          std::vector<int>(outputs, std::numeric_limits<int>::max()),
                          {},
                          record.measured.length_s});
  }
  std::vector<int>& orders = conditions[record.condition].orders;
  for (std::size_t o = 0; o < orders.size(); ++o) {
    orders[o] = std::min(orders[o], orders_of(record.measured, o));
  }
}

std::optional<hal::ConfigFault> solve_nominal(const sim::SteadyPlant& steady,
                                              std::vector<OrderCondition>& conditions) {
  const sim::PeriodOrders orders = steady.orders_up_to(highest_order(conditions));
  std::vector<std::optional<hal::ConfigFault>> faults(conditions.size());
  parallel_for(conditions.size(), [&](std::size_t c) {
    auto state = steady.under(conditions[c].inputs, orders);
    if (auto* fault = std::get_if<hal::ConfigFault>(&state)) {
      faults[c] = std::move(*fault);
    } else {
      conditions[c].nominal = std::get<sim::SteadyState>(std::move(state));
    }
  });
  for (auto& fault : faults) {
    if (fault) return std::move(fault);
  }
  return std::nullopt;
}

// What records show of the nominal speeds: each, and on average those that are learned from.
void compare_speeds(OrderCampaign& made) {
  std::vector<double> sums(made.conditions.size()), counts(sums.size());
  for (OrderRecord& record : made.records) {
    const sim::SteadyState& nominal = made.conditions[record.condition].nominal;
    record.speed_share =
        units::two_pi * record.measured.speed_Hz / std::abs(nominal.speed_rad_s[made.turning]);
    if (!record.about.learned_from) continue;
    sums[record.condition] += record.speed_share;
    ++counts[record.condition];
  }
  for (std::size_t c = 0; c < sums.size(); ++c) {
    if (counts[c] > 0) made.conditions[c].speed_share = sums[c] / counts[c];
  }
}

// What follows time, where the record itself has it: slip changes as a rotor warms. What goes round
// is measured anew without it: a strong line leaks into weak ones that are not far.
void measure_timed(const sim::PlantSpec& plant, const OrderCondition& condition,
                   const Recording& recording, double period_turns, OrderRecord& record) {
  const auto shaft = analysis::ShaftAngle::of(recording);
  std::vector<Channel> without;
  for (const sim::OutputSpec& output : plant.outputs) {
    without.push_back(*recording.find(output.channel));
  }
  for (const OrderFeature& line : timed_lines(plant, condition)) {
    const Channel& channel = *recording.find(plant.outputs[line.output].channel);
    const double line_Hz = frequency_Hz(plant, condition, line, record.speed_share);
    record.timed.push_back(analysis::line_at(channel, line_Hz));
    analysis::take_out_line(without[line.output], line_Hz);
  }
  for (std::size_t o = 0; o < without.size(); ++o) {
    if (condition.orders[o] == 0) continue;
    analysis::PeriodLines& lines = record.measured.outputs[o];
    if (auto alone = analysis::period_lines(without[o], *shaft, period_turns)) lines = *alone;
  }
}

}  // namespace

std::variant<OrderCampaign, Refusal> order_campaign(const sim::PlantSpec& plant,
                                                    const Campaign& campaign,
                                                    const sim::TermLibrary& library) {
  OrderCampaign made;
  const auto angle =
      std::ranges::find(plant.outputs, channel_names::input_angle, &sim::OutputSpec::channel);
  if (angle == plant.outputs.end() || angle->kind != sim::OutputKind::position) {
    return Refusal{
        {{0, "/outputs", "a plant that is compared by orders shows a position input_angle"}},
        false};
  }
  made.angle = static_cast<std::size_t>(angle - plant.outputs.begin());
  const auto steady = sim::SteadyPlant::make(plant, library);
  if (const auto* fault = std::get_if<hal::ConfigFault>(&steady)) return Refusal{{*fault}, false};
  made.turning = sim::index_of(plant.bodies, angle->of);
  made.period_turns = std::abs(std::get<sim::SteadyPlant>(steady).turns_per_period()[made.turning]);
  Refusal refusal{{}, true};
  std::vector<Eigen::VectorXd> under;
  for (const CampaignRecord& of : campaign.records) {
    auto inputs = steady_inputs(plant, of.recording);
    auto measured = measure_orders(plant, of.recording, made.angle, made.period_turns);
    if (const auto* fault = std::get_if<hal::ConfigFault>(&inputs)) {
      refusal.faults.push_back({0, fault->pointer, of.name + ": " + fault->message});
    } else if (const auto* why = std::get_if<std::string>(&measured)) {
      refusal.faults.push_back({0, "", of.name + ": " + *why});
    } else {
      under.push_back(std::get<Eigen::VectorXd>(std::move(inputs)));
      made.records.push_back(
          {of, 0, std::get<OrderMeasurement>(std::move(measured)), {}, {}, {}, {}});
    }
  }
  if (!refusal.faults.empty()) return refusal;
  if (std::ranges::none_of(made.records,
                           [](const OrderRecord& r) { return r.about.learned_from; })) {
    return Refusal{{{0, "", "there is no recording to learn from"}}, true};
  }
  for (std::size_t i = 0; i < made.records.size(); ++i)
    sort_in(made.records[i], under[i], plant.outputs.size(), made.conditions);
  if (auto fault = solve_nominal(std::get<sim::SteadyPlant>(steady), made.conditions))
    return Refusal{{*std::move(fault)}, false};
  compare_speeds(made);
  for (std::size_t i = 0; i < made.records.size(); ++i) {
    OrderRecord& record = made.records[i];
    measure_timed(plant, made.conditions[record.condition], campaign.records[i].recording,
                  made.period_turns, record);
  }
  return made;
}

}  // namespace rvbench::bench
