#include "bench/order_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "bench/order_errors.hpp"
#include "hal/types/units.hpp"
#include "sim/mains.hpp"
#include "sim/named.hpp"

namespace rvbench::bench {
namespace {

using analysis::LockedTo;

constexpr double worth_comparing = 0.1;  // of an effect's largest line
constexpr double again_above_noise =
    3;                               // in more than half of the repeats: by chance 1 in 20 million
constexpr double strong_line = 0.1;  // of the strongest that goes round
constexpr double same_line = 0.1;
constexpr double fewest_periods = 3;  // of a line in a record: else its mean is in the way
constexpr std::array<int, 4> supply_harmonics{1, 2, 6, 12};

// Orders of the strong lines that go round.
std::vector<int> strong_orders(const sim::SteadyOutput& nominal) {
  const Eigen::VectorXd lines = nominal.shaft_lines.cwiseAbs();
  std::vector<int> orders;
  if (lines.size() < 2) return orders;
  const double least = strong_line * lines.tail(lines.size() - 1).maxCoeff();
  for (Eigen::Index k = 1; k < lines.size(); ++k) {
    if (least > 0 && lines[k] >= least) orders.push_back(static_cast<int>(k));
  }
  return orders;
}

// Whether a line stands above noise again and again: once it may be what one record alone has.
bool rises_clearly(const std::vector<const OrderRecord*>& repeats, std::size_t output,
                   Eigen::Index order) {
  const double least = repeats.size() > 1 ? again_above_noise : clearly_above_noise;
  const auto clear = std::ranges::count_if(repeats, [&](const OrderRecord* record) {
    const analysis::PeriodLines& lines = record->measured.outputs[output];
    return lines.amplitude[order] > least * lines.noise[order];
  });
  return 2 * static_cast<std::size_t>(clear) > repeats.size();
}

// Which orders of each output to compare: those that recordings of one condition show, and those
// that the plant or some effect would bring.
std::vector<std::vector<bool>> shown_orders(const sim::PlantSpec& plant,
                                            const std::vector<OrderRecord>& records,
                                            const std::vector<OrderCondition>& conditions) {
  const auto size = static_cast<std::size_t>(highest_order(conditions)) + 1;
  std::vector<std::vector<bool>> shown(plant.outputs.size(), std::vector<bool>(size));
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    const auto repeats = telling_of(c, records);
    if (!repeats.front()->about.learned_from) continue;
    for (std::size_t o = 0; o < plant.outputs.size(); ++o) {
      for (Eigen::Index k = 1; k <= conditions[c].orders[o]; ++k) {
        const double expected = std::abs(conditions[c].nominal.outputs[o].shaft_lines[k]);
        const bool is_expected = std::ranges::any_of(repeats, [&](const OrderRecord* record) {
          return expected > record->measured.outputs[o].noise[k];
        });
        if (is_expected || rises_clearly(repeats, o, k)) shown[o][std::size_t(k)] = true;
      }
    }
  }
  return shown;
}

// Those that a candidate of usual size would bring.
void add_orders_of(const std::vector<CandidateProbe>& probes,
                   const std::vector<OrderCondition>& conditions,
                   std::vector<std::vector<bool>>& shown) {
  const std::vector<std::size_t> probed = probed_conditions(conditions);
  for (const CandidateProbe& probe : probes) {
    for (std::size_t i = 0; i < probe.states.size(); ++i) {
      const sim::SteadyState& nominal = conditions[probed[i]].nominal;
      for (std::size_t o = 0; o < shown.size(); ++o) {
        const Eigen::VectorXd change =
            (probe.states[i].outputs[o].shaft_lines - nominal.outputs[o].shaft_lines).cwiseAbs();
        const double least = worth_comparing * change.tail(change.size() - 1).maxCoeff();
        for (Eigen::Index k = 1; k < change.size(); ++k) {
          if (least > 0 && change[k] >= least) shown[o][std::size_t(k)] = true;
        }
      }
    }
  }
}

double supplied_Hz(const sim::PlantSpec& plant, const OrderCondition& condition,
                   std::size_t input) {
  const sim::InputSpec& supply = plant.inputs[input];
  return supply.gain.value * condition.inputs[Eigen::Index(input)] + supply.offset.value;
}

// Twice the slip frequency of a motor at this share of its nominal speed.
double twice_slip_Hz(const sim::PlantSpec& plant, const OrderCondition& condition,
                     const sim::TermSpec& motor, double speed_share) {
  const int supply = sim::index_of(plant.inputs, motor.reference);
  const double turns_Hz = speed_share / units::two_pi *
                          condition.nominal.speed_rad_s[sim::index_of(plant.bodies, motor.body_a)];
  const double pole_pairs = motor.parameters.at("pole_pairs").value;
  return 2 * std::abs(supplied_Hz(plant, condition, std::size_t(supply)) - pole_pairs * turns_Hz);
}

struct Rhythm {
  double frequency_Hz = 0;
  std::string slip_of = {};
};

// What the bench may bring, the same number of them under all conditions.
std::vector<Rhythm> rhythms_of(const sim::PlantSpec& plant, const OrderCondition& condition) {
  std::vector<Rhythm> rhythms;
  for (const double mains_Hz : sim::mains_frequencies_Hz) rhythms.push_back({mains_Hz});
  for (std::size_t i = 0; i < plant.inputs.size(); ++i) {
    if (plant.inputs[i].kind != sim::InputKind::signal) continue;
    const double supply_Hz = supplied_Hz(plant, condition, i);
    for (const int harmonic : supply_harmonics) rhythms.push_back({harmonic * supply_Hz});
  }
  for (const sim::TermSpec& term : plant.terms) {
    if (term.type != "induction_motor") continue;
    if (sim::index_of(plant.inputs, term.reference) < 0) continue;
    rhythms.push_back({twice_slip_Hz(plant, condition, term, condition.speed_share), term.name});
  }
  return rhythms;
}

}  // namespace

std::vector<OrderFeature> timed_lines(const sim::PlantSpec& plant,
                                      const OrderCondition& condition) {
  const std::vector<Rhythm> rhythms = rhythms_of(plant, condition);
  std::vector<OrderFeature> lines;
  for (std::size_t o = 0; o < plant.outputs.size(); ++o) {
    const double highest_Hz = double(condition.orders[o]) * condition.nominal.period_Hz;
    for (std::size_t i = 0; i < rhythms.size(); ++i) {
      const auto& [frequency_Hz, slip_of] = rhythms[i];
      if (frequency_Hz >= highest_Hz) continue;
      if (frequency_Hz * condition.length_s < fewest_periods) continue;
      lines.push_back({LockedTo::time, o, static_cast<int>(i), frequency_Hz, slip_of});
    }
  }
  return lines;
}

double frequency_Hz(const sim::PlantSpec& plant, const OrderCondition& condition,
                    const OrderFeature& line, double speed_share) {
  if (line.slip_of.empty()) return line.frequency_Hz;
  return twice_slip_Hz(plant, condition, *plant.find_term(line.slip_of), speed_share);
}

std::vector<double> orders_of_timed(const sim::PlantSpec& plant, const OrderCondition& condition,
                                    const std::vector<const OrderRecord*>& records,
                                    double period_turns, std::size_t output) {
  const std::vector<int> strong = strong_orders(condition.nominal.outputs[output]);
  const std::vector<OrderFeature> timed = timed_lines(plant, condition);
  std::vector<double> orders;
  for (const OrderRecord* record : records) {
    const double period_Hz = record->measured.speed_Hz / period_turns;
    for (const OrderFeature& line : timed) {
      const double order = frequency_Hz(plant, condition, line, record->speed_share) / period_Hz;
      orders.push_back(order);
      for (const int other : strong) {
        orders.push_back(order + other);
        orders.push_back(std::abs(order - other));
      }
    }
  }
  return orders;
}

int highest_order(const std::vector<OrderCondition>& conditions) {
  int highest = 0;
  for (const OrderCondition& condition : conditions) {
    highest = std::max(highest, std::ranges::max(condition.orders));
  }
  return highest;
}

std::vector<std::size_t> probed_conditions(const std::vector<OrderCondition>& conditions) {
  std::vector<std::size_t> some{0, conditions.size() / 2, conditions.size() - 1};
  some.erase(std::unique(some.begin(), some.end()), some.end());
  return some;
}

std::vector<double> strong_lines_Hz(const std::vector<OrderCondition>& conditions) {
  std::vector<double> all_Hz;
  const auto add = [&](double line_Hz) {
    const bool is_known = std::ranges::any_of(all_Hz, [&](double known_Hz) {
      return std::abs(known_Hz - line_Hz) < same_line * line_Hz;
    });
    if (!is_known && line_Hz > 0) all_Hz.push_back(line_Hz);
  };
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const OrderCondition& condition = conditions[(i + conditions.size() / 2) % conditions.size()];
    const sim::SteadyState& nominal = condition.nominal;
    for (std::size_t o = 0; o < nominal.outputs.size(); ++o) {
      const double highest_Hz = condition.orders[o] * nominal.period_Hz;
      const Eigen::VectorXd timed = nominal.outputs[o].timed_lines.cwiseAbs();
      for (Eigen::Index line = 0; line < timed.size(); ++line) {
        const double line_Hz = nominal.rhythms_Hz[std::size_t(line)];
        if (timed[line] >= strong_line * timed.maxCoeff() && line_Hz < highest_Hz) add(line_Hz);
      }
      for (const int order : strong_orders(nominal.outputs[o])) {
        if (order <= condition.orders[o]) add(order * nominal.period_Hz);
      }
    }
  }
  return all_Hz;
}

void choose_features(const sim::PlantSpec& plant, const std::vector<OrderRecord>& records,
                     const std::vector<CandidateProbe>& probes, double period_turns,
                     std::vector<OrderCondition>& conditions) {
  std::vector<std::vector<bool>> shown = shown_orders(plant, records, conditions);
  add_orders_of(probes, conditions, shown);
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    OrderCondition& condition = conditions[c];
    const std::vector<OrderFeature> timed = timed_lines(plant, condition);
    for (std::size_t o = 0; o < plant.outputs.size(); ++o) {
      const std::vector<double> timed_orders =
          orders_of_timed(plant, condition, telling_of(c, records), period_turns, o);
      condition.features.push_back({LockedTo::nothing, o, 0, 0});
      for (int k = 1; k <= condition.orders[o]; ++k) {
        if (!shown[o][std::size_t(k)]) continue;
        if (std::ranges::any_of(timed_orders, [&](double at) { return std::abs(at - k) < 1; }))
          continue;
        condition.features.push_back({LockedTo::shaft, o, k, 0});
      }
    }
    condition.features.insert(condition.features.end(), timed.begin(), timed.end());
  }
}

}  // namespace rvbench::bench
