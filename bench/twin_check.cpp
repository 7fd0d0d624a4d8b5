#include "bench/twin_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <variant>
#include <vector>

#include "bench/campaign_points.hpp"
#include "bench/order_features.hpp"
#include "bench/planned_inputs.hpp"
#include "bench/report/html.hpp"
#include "hal/types/parallel_for.hpp"
#include "sim/named.hpp"
#include "sim/plant_json.hpp"
#include "sim/steady_state.hpp"

namespace rvbench::bench {
namespace {

constexpr double standard_errors = 3;
constexpr double tolerances = 2;
constexpr double worth_telling = 0.015;  // of the largest mean: good units reach 0.014

struct Condition {
  std::string name;
  Eigen::VectorXd inputs;
  std::vector<OrderMeasurement> repeats;
};

// Mean and lines of one output, measured or simulated: element 0 is the mean.
using Shown = Eigen::VectorXd;

struct Difference {
  std::string text;
  double beyond = 0;  // what it may be, in the output's unit
};

Eigen::Index orders_of(const Condition& condition, std::size_t output) {
  Eigen::Index orders = condition.repeats.front().outputs[output].amplitude.size() - 1;
  for (const OrderMeasurement& repeat : condition.repeats) {
    orders = std::min(orders, repeat.outputs[output].amplitude.size() - 1);
  }
  return orders;
}

Shown shown_by(const analysis::PeriodLines& lines, Eigen::Index orders) {
  Shown shown = lines.amplitude.head(orders + 1);
  shown[0] = lines.mean;
  return shown;
}

Shown shown_by(const sim::SteadyOutput& output, Eigen::Index orders) {
  Shown shown = output.shaft_lines.head(orders + 1).cwiseAbs();
  shown[0] = output.mean;
  return shown;
}

// The plant, and once more for each quantity that has a tolerance, with all of it used.
std::vector<sim::PlantSpec> with_tolerances_used(const sim::PlantSpec& plant) {
  std::vector<sim::PlantSpec> all{plant};
  sim::PlantSpec moved = plant;
  for (const sim::PlacedQuantity& placed : sim::quantities(moved)) {
    const double value = placed.quantity->value;
    const double tolerance = value * placed.quantity->tolerance_pct / 100;
    if (tolerance == 0) continue;
    placed.quantity->value = value + tolerance;
    all.push_back(moved);
    placed.quantity->value = value;
  }
  return all;
}

class TwinComparison {
 public:
  TwinComparison(const sim::PlantSpec& plant, std::size_t angle)
      : plant_(plant), angle_(angle), plants_(with_tolerances_used(plant)) {}

  // @return why the plant cannot be solved; empty if it can
  std::string make_steady() {
    for (const sim::PlantSpec& plant : plants_) {
      auto made = sim::SteadyPlant::make(plant);
      if (const auto* fault = std::get_if<hal::ConfigFault>(&made)) return fault->message;
      steady_.push_back(std::get<sim::SteadyPlant>(std::move(made)));
    }
    const int body = sim::index_of(plant_.bodies, plant_.outputs[angle_].of);
    period_turns_ = std::abs(steady_.front().turns_per_period()[body]);
    return {};
  }

  // @return why the records cannot be compared; empty if they can
  std::string take(const Campaign& campaign) {
    for (const CampaignRecord& record : campaign.records) {
      auto inputs = steady_inputs(plant_, record.recording);
      if (const auto* fault = std::get_if<hal::ConfigFault>(&inputs)) return fault->message;
      auto measured = measure_orders(plant_, record.recording, angle_, period_turns_);
      if (const auto* why = std::get_if<std::string>(&measured)) return record.name + ": " + *why;
      const auto& under = std::get<Eigen::VectorXd>(inputs);
      auto known = std::ranges::find(conditions_, under, &Condition::inputs);
      if (known == conditions_.end()) {
        known = conditions_.insert(known, {record.condition, under, {}});
      }
      known->repeats.push_back(std::get<OrderMeasurement>(std::move(measured)));
    }
    return {};
  }

  TwinCheck worst() const {
    std::vector<std::variant<Difference, std::string>> of(conditions_.size());
    parallel_for(of.size(), [&](std::size_t c) { of[c] = difference_under(conditions_[c]); });
    Difference worst;
    for (auto& one : of) {
      if (auto* why = std::get_if<std::string>(&one)) return {"", std::move(*why)};
      Difference& difference = std::get<Difference>(one);
      if (difference.beyond > worst.beyond) worst = std::move(difference);
    }
    return {worst.text, ""};
  }

 private:
  std::variant<Difference, std::string> difference_under(const Condition& condition) const {
    int highest = 1;
    for (std::size_t o = 0; o < plant_.outputs.size(); ++o) {
      if (o != angle_) highest = std::max(highest, static_cast<int>(orders_of(condition, o)));
    }
    std::vector<sim::SteadyState> states;
    for (const sim::SteadyPlant& steady : steady_) {
      auto state = steady.under(condition.inputs, steady.orders_up_to(highest),
                                states.empty() ? nullptr : &states.front());
      if (const auto* fault = std::get_if<hal::ConfigFault>(&state)) return fault->message;
      states.push_back(std::get<sim::SteadyState>(std::move(state)));
    }
    Difference worst;
    for (std::size_t o = 0; o < plant_.outputs.size(); ++o) {
      if (o == angle_) continue;
      Difference difference = worst_of(condition, o, states);
      if (difference.beyond > worst.beyond) worst = std::move(difference);
    }
    return worst;
  }

  Difference worst_of(const Condition& condition, std::size_t o,
                      const std::vector<sim::SteadyState>& states) const {
    const Eigen::Index orders = orders_of(condition, o);
    const Shown simulated = shown_by(states.front().outputs[o], orders);
    Shown allowed = Shown::Zero(orders + 1);
    for (const sim::SteadyState& state : states) {
      allowed += (shown_by(state.outputs[o], orders) - simulated).cwiseAbs2();
    }
    allowed = tolerances * allowed.cwiseSqrt();
    allowed.tail(orders).array() += worth_telling * largest_mean(o);
    const auto count = static_cast<double>(condition.repeats.size());
    Shown measured = Shown::Zero(orders + 1), squares = measured;
    for (const OrderMeasurement& repeat : condition.repeats) {
      measured += shown_by(repeat.outputs[o], orders) / count;
    }
    for (const OrderMeasurement& repeat : condition.repeats) {
      squares += (shown_by(repeat.outputs[o], orders) - measured).cwiseAbs2();
    }
    if (count > 1) allowed += standard_errors * (squares / (count - 1) / count).cwiseSqrt();
    Eigen::Index at = 0;
    const double beyond = ((measured - simulated).cwiseAbs() - allowed).maxCoeff(&at);
    return {text_of(condition, plant_.outputs[o], at, measured[at], simulated[at]), beyond};
  }

  double largest_mean(std::size_t o) const {
    double largest = 0;
    for (const Condition& condition : conditions_) {
      for (const OrderMeasurement& repeat : condition.repeats) {
        largest = std::max(largest, std::abs(repeat.outputs[o].mean));
      }
    }
    return largest;
  }

  std::string text_of(const Condition& condition, const sim::OutputSpec& output, Eigen::Index at,
                      double measured, double simulated) const {
    const std::string what =
        at == 0
            ? "its mean"
            : "order " + report::order_text(static_cast<double>(at) / period_turns_, period_turns_);
    return fmt::format("{}, {} at {}: {:.3g} {} measured, {:.3g} simulated", output.channel, what,
                       condition.name, measured, output.unit, simulated);
  }

  const sim::PlantSpec& plant_;
  std::size_t angle_;
  std::vector<sim::PlantSpec> plants_;  // as the file has it, then with each tolerance used
  std::vector<sim::SteadyPlant> steady_;
  double period_turns_ = 1;
  std::vector<Condition> conditions_;
};

std::string event_of(const std::filesystem::path& run, const std::string& plant_name) {
  const auto not_compared = [](const std::string& why) {
    return "not compared with its twin: " + why;
  };
  const auto plant = sim::read_plant(plant_name);
  if (plant.index() == 1) return not_compared(plant_name + " cannot be read");
  const auto& spec = std::get<0>(plant);
  auto read = campaign_of_run(run, channels_of(spec));
  if (const auto* refusal = std::get_if<Refusal>(&read)) {
    return not_compared(refusal->faults.front().message);
  }
  Campaign& campaign = std::get<0>(read);
  add_planned_inputs(spec, campaign);
  const TwinCheck check = check_twin(spec, campaign);
  if (!check.not_compared.empty()) return not_compared(check.not_compared);
  if (check.difference.empty()) return "as its twin " + plant_name + ", within its tolerances";
  return fmt::format("{} {}: {}; rvbench explain {} says why", differs_from_twin, plant_name,
                     check.difference, run.string());
}

}  // namespace

TwinCheck check_twin(const sim::PlantSpec& plant, const Campaign& campaign) {
  const auto angle =
      std::ranges::find(plant.outputs, channel_names::input_angle, &sim::OutputSpec::channel);
  const bool by_orders = angle != plant.outputs.end() && angle->kind == sim::OutputKind::position &&
                         angle->compared_by == sim::ComparedBy::orders;
  if (!by_orders) return {"", "the plant is not compared by orders of input_angle"};
  sim::PlantSpec own = plant;
  for (const sim::PlacedQuantity& placed : sim::quantities(own)) {
    if (std::isfinite(placed.quantity->tolerance_pct)) continue;
    return {"", placed.pointer + " of the plant is to be identified first"};
  }
  TwinComparison comparison(plant, static_cast<std::size_t>(angle - plant.outputs.begin()));
  std::string why = comparison.make_steady();
  if (why.empty()) why = comparison.take(campaign);
  if (!why.empty()) return {"", std::move(why)};
  return comparison.worst();
}

std::string twin_event(const std::filesystem::path& run, const std::string& plant) noexcept {
  try {
    return event_of(run, plant);
  } catch (const std::exception& error) {  // a comparison beside the run: never its end
    return std::string("not compared with its twin: ") + error.what();
  }
}

}  // namespace rvbench::bench
