#include "bench/order_twin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "bench/order_choice.hpp"
#include "bench/order_errors.hpp"
#include "bench/order_pushes.hpp"
#include "hal/types/parallel_for.hpp"
#include "hal/types/units.hpp"
#include "sim/mains.hpp"
#include "sim/named.hpp"
#include "sim/plant_check.hpp"

namespace rvbench::bench {
namespace {

using analysis::LockedTo;

constexpr double believable = 5;  // standard errors: farther off counts for little more
constexpr double one_line = 1.5;  // orders of a period: neighbours show one another

int orders_of(const OrderMeasurement& measured, std::size_t output) {
  return std::max(0, static_cast<int>(measured.outputs[output].amplitude.size()) - 1);
}

// The root of Cauchy's loss, with its sign: where physics is missing, lines are a hundred standard
// errors off, and must not bend the numbers that the other lines tell.
double pressed(double standard_errors) {
  const double part = standard_errors / believable;
  return std::copysign(believable * std::sqrt(std::log1p(part * part)), standard_errors);
}

double place_of(const OrderFeature& feature, double period_turns) {
  return feature.locked_to == LockedTo::shaft ? feature.order / period_turns : feature.frequency_Hz;
}

}  // namespace

TwinOrRefusal OrderTwin::make(sim::PlantSpec plant, const Campaign& campaign,
                              const sim::TermLibrary& library) {
  if (auto faults = sim::check_plant(plant, library); !faults.empty()) {
    return Refusal{std::move(faults), false};
  }
  std::unique_ptr<OrderTwin> twin(new OrderTwin(std::move(plant), library));
  if (Refusal refusal = twin->load(campaign); !refusal.faults.empty()) return refusal;
  twin->family_.emplace(twin->plant_, twin->scales(), library);
  twin->base_ = twin->family_->base_by_tolerance();
  const std::vector<CandidateProbe> probes = twin->probe();
  choose_features(twin->plant_, twin->records_, probes, twin->period_turns_, twin->conditions_);
  for (OrderRecord& record : twin->records_) {
    read_features(twin->conditions_[record.condition], record);
  }
  find_errors(twin->conditions_, twin->plant_.outputs.size(), twin->records_);
  group_candidates(*twin->family_, twin->marks_of(probes));
  twin->cut_units();
  return std::unique_ptr<Twin>(std::move(twin));
}

Refusal OrderTwin::load(const Campaign& campaign) {
  const auto angle =
      std::ranges::find(plant_.outputs, channel_names::input_angle, &sim::OutputSpec::channel);
  if (angle == plant_.outputs.end() || angle->kind != sim::OutputKind::position) {
    return {{{0, "/outputs", "a plant that is compared by orders shows a position input_angle"}},
            false};
  }
  angle_ = static_cast<std::size_t>(angle - plant_.outputs.begin());
  const auto steady = sim::SteadyPlant::make(plant_, terms_);
  if (const auto* fault = std::get_if<hal::ConfigFault>(&steady)) return {{*fault}, false};
  turning_ = sim::index_of(plant_.bodies, angle->of);
  period_turns_ = std::abs(std::get<sim::SteadyPlant>(steady).turns_per_period()[turning_]);
  Refusal refusal{{}, true};
  std::vector<Eigen::VectorXd> under;
  for (const CampaignRecord& of : campaign.records) {
    auto inputs = steady_inputs(plant_, of.recording);
    auto measured = measure_orders(plant_, of.recording, angle_, period_turns_);
    if (const auto* fault = std::get_if<hal::ConfigFault>(&inputs)) {
      refusal.faults.push_back({0, fault->pointer, of.name + ": " + fault->message});
    } else if (const auto* why = std::get_if<std::string>(&measured)) {
      refusal.faults.push_back({0, "", of.name + ": " + *why});
    } else {
      under.push_back(std::get<Eigen::VectorXd>(std::move(inputs)));
      records_.push_back({of, 0, std::get<OrderMeasurement>(std::move(measured)), {}, {}, {}, {}});
    }
  }
  if (!refusal.faults.empty()) return refusal;
  if (std::ranges::none_of(records_, [](const OrderRecord& r) { return r.about.learned_from; })) {
    return {{{0, "", "there is no recording to learn from"}}, true};
  }
  for (std::size_t i = 0; i < records_.size(); ++i) sort_in(records_[i], under[i]);
  if (auto fault = solve_nominal(std::get<sim::SteadyPlant>(steady)))
    return {{*std::move(fault)}, false};
  compare_speeds();
  for (std::size_t i = 0; i < records_.size(); ++i) {
    const Recording& recording = campaign.records[i].recording;
    for (const OrderFeature& line : timed_lines(plant_, conditions_[records_[i].condition])) {
      const Channel& channel = *recording.find(plant_.outputs[line.output].channel);
      records_[i].timed.push_back(analysis::line_at(channel, line.frequency_Hz));
    }
  }
  return {};
}

// Finds the record's condition, or opens one; it shows as many orders as all of its records do.
void OrderTwin::sort_in(OrderRecord& record, const Eigen::VectorXd& inputs) {
  const auto known = std::ranges::find(conditions_, inputs, &OrderCondition::inputs);
  record.condition = static_cast<std::size_t>(known - conditions_.begin());
  if (known == conditions_.end()) {
    conditions_.push_back({inputs,
                           {},
                           std::vector<int>(plant_.outputs.size(), std::numeric_limits<int>::max()),
                           {},
                           record.measured.length_s});
  }
  std::vector<int>& orders = conditions_[record.condition].orders;
  for (std::size_t o = 0; o < orders.size(); ++o) {
    orders[o] = std::min(orders[o], orders_of(record.measured, o));
  }
}

std::optional<hal::ConfigFault> OrderTwin::solve_nominal(const sim::SteadyPlant& steady) {
  const sim::PeriodOrders orders = steady.orders_up_to(highest_order(conditions_));
  std::vector<std::optional<hal::ConfigFault>> faults(conditions_.size());
  parallel_for(conditions_.size(), [&](std::size_t c) {
    auto state = steady.under(conditions_[c].inputs, orders);
    if (auto* fault = std::get_if<hal::ConfigFault>(&state)) {
      faults[c] = std::move(*fault);
    } else {
      conditions_[c].nominal = std::get<sim::SteadyState>(std::move(state));
    }
  });
  for (auto& fault : faults) {
    if (fault) return std::move(fault);
  }
  return std::nullopt;
}

void OrderTwin::compare_speeds() {
  for (std::size_t c = 0; c < conditions_.size(); ++c) {
    double sum_Hz = 0, count = 0;
    for (const OrderRecord& record : records_) {
      if (record.condition != c) continue;
      sum_Hz += record.measured.speed_Hz;
      ++count;
    }
    conditions_[c].speed_share =
        units::two_pi * sum_Hz / count / std::abs(conditions_[c].nominal.speed_rad_s[turning_]);
  }
}

ParameterScales OrderTwin::scales() const {
  double torque = 0, speed = 0, count = 0;
  for (const OrderRecord& record : records_) {
    if (!record.about.learned_from) continue;
    for (std::size_t o = 0; o < plant_.outputs.size(); ++o) {
      double& sum = o == angle_ ? speed : torque;
      sum += std::pow(record.measured.outputs[o].mean, 2);
    }
    ++count;
  }
  const auto others = static_cast<double>(plant_.outputs.size()) - 1;
  const double force = std::sqrt(torque / count / std::max(others, 1.0));
  const Eigen::VectorXd& speeds = conditions_.front().nominal.speed_rad_s;
  std::vector<double> turns;
  for (const double body_rad_s : speeds) turns.push_back(body_rad_s / speeds[turning_]);
  return {{force, 1e-3, std::sqrt(speed / count)},
          1e-3,
          force,
          {sim::mains_frequencies_Hz.begin(), sim::mains_frequencies_Hz.end()},
          std::move(turns)};
}

// What each candidate of usual size changes of the first record of each probed condition, in
// standard errors.
Eigen::MatrixXd OrderTwin::marks_of(const std::vector<CandidateProbe>& probes) const {
  std::vector<Eigen::VectorXd> columns(probes.size());
  Eigen::Index rows = 0;
  const std::vector<std::size_t> probed = probed_conditions(conditions_);
  for (std::size_t p = 0; p < probed.size(); ++p) {
    const auto record = std::ranges::find(records_, probed[p], &OrderRecord::condition);
    const OrderCondition& condition = conditions_[probed[p]];
    const Eigen::VectorXd before = shown_by(features_of(condition.nominal, condition), *record);
    rows += before.size();
    for (std::size_t i = 0; i < probes.size(); ++i) {
      Eigen::VectorXd& column = columns[i];
      column.conservativeResizeLike(Eigen::VectorXd::Zero(rows));
      if (!probes[i].fault.empty()) continue;
      column.tail(before.size()) =
          (shown_by(features_of(probes[i].states[p], condition), *record) - before)
              .cwiseQuotient(record->errors);
    }
  }
  Eigen::MatrixXd marks(rows, Eigen::Index(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) marks.col(Eigen::Index(i)) = columns[i];
  return marks;
}

std::vector<CandidateProbe> OrderTwin::probe() {
  const std::vector<std::size_t> probed = probed_conditions(conditions_);
  auto probes = probe_candidates(
      *family_, [&](const sim::PlantSpec& plant) { return states_of(plant, probed); });
  for (std::size_t i = 0; i < probes.size(); ++i) {
    if (!probes[i].fault.empty()) family_->cannot_show(i, probes[i].fault);
  }
  return probes;
}

void OrderTwin::cut_units() {
  Eigen::Index at = 0;
  for (const OrderRecord& record : records_) {
    if (!record.about.learned_from) continue;
    units_.push_back({record.about.name, record.about.condition, record.about.speed,
                      record.about.load, at, record.values.size(), record.about.programme});
    at += record.values.size();
  }
}

std::variant<std::vector<sim::SteadyState>, hal::ConfigFault> OrderTwin::states_of(
    const sim::PlantSpec& plant, const std::vector<std::size_t>& conditions) const {
  const auto made = sim::SteadyPlant::make(plant, terms_);
  if (const auto* fault = std::get_if<hal::ConfigFault>(&made)) return *fault;
  const auto& steady = std::get<sim::SteadyPlant>(made);
  const sim::PeriodOrders orders = steady.orders_up_to(highest_order(conditions_));
  std::vector<sim::SteadyState> states;
  for (const std::size_t c : conditions) {
    auto state = steady.under(conditions_[c].inputs, orders, &conditions_[c].nominal);
    if (const auto* fault = std::get_if<hal::ConfigFault>(&state)) return *fault;
    states.push_back(std::get<sim::SteadyState>(std::move(state)));
  }
  return states;
}

std::optional<std::vector<sim::SteadyState>> OrderTwin::solved(
    const std::vector<std::size_t>& effects, const std::vector<double>& values) const {
  std::vector<std::size_t> all(conditions_.size());
  std::iota(all.begin(), all.end(), 0);
  auto states = states_of(plant_with(effects, values), all);
  if (std::holds_alternative<hal::ConfigFault>(states)) return std::nullopt;
  return std::get<0>(std::move(states));
}

// Means, and amplitudes of lines.
Eigen::VectorXd OrderTwin::features_of(const sim::SteadyState& state,
                                       const OrderCondition& condition) const {
  Eigen::VectorXd features(static_cast<Eigen::Index>(condition.features.size()));
  for (std::size_t f = 0; f < condition.features.size(); ++f) {
    const OrderFeature& feature = condition.features[f];
    const std::complex<double> value = predicted(state, feature, condition.length_s);
    features[Eigen::Index(f)] =
        feature.locked_to != LockedTo::nothing ? std::abs(value)
        : feature.output != angle_
            ? value.real()
            : std::abs(plant_.outputs[angle_].gain.value * state.speed_rad_s[turning_]);
  }
  return features;
}

// What the record would show of its features on average, noise included.
Eigen::VectorXd OrderTwin::shown_by(Eigen::VectorXd features, const OrderRecord& record) const {
  const std::vector<OrderFeature>& of = conditions_[record.condition].features;
  for (Eigen::Index f = 0; f < features.size(); ++f) {
    if (of[std::size_t(f)].locked_to == LockedTo::nothing) continue;
    features[f] = with_noise(features[f], record.noise[f]);
  }
  return features;
}

std::optional<Eigen::VectorXd> OrderTwin::residuals(const std::vector<std::size_t>& effects,
                                                    const std::vector<double>& values,
                                                    const std::vector<bool>&) const {
  stop_if_asked();
  const auto states = solved(effects, values);
  if (!states) return std::nullopt;
  std::vector<Eigen::VectorXd> features;
  for (std::size_t c = 0; c < conditions_.size(); ++c) {
    features.push_back(features_of((*states)[c], conditions_[c]));
  }
  Eigen::VectorXd apart(units_.back().first + units_.back().size);
  auto unit = units_.begin();
  for (const OrderRecord& record : records_) {
    if (!record.about.learned_from) continue;
    apart.segment(unit->first, unit->size) =
        (record.values - shown_by(features[record.condition], record))
            .cwiseQuotient(record.errors)
            .unaryExpr(&pressed);
    ++unit;
  }
  return apart;
}

Twin::Cells OrderTwin::cells(const std::vector<std::size_t>& effects,
                             const std::vector<double>& values) const {
  Cells cells{{}, one_line / period_turns_};
  const auto states = solved(effects, values);
  if (!states) return cells;
  for (std::size_t c = 0; c < conditions_.size(); ++c) {
    const Eigen::VectorXd expected = features_of((*states)[c], conditions_[c]);
    std::vector<const OrderRecord*> records;
    for (const OrderRecord& record : records_) {
      if (record.condition == c && record.about.learned_from) records.push_back(&record);
    }
    if (records.empty()) continue;
    const auto count = static_cast<double>(records.size());
    Eigen::VectorXd apart = Eigen::VectorXd::Zero(expected.size()), squares = apart;
    for (const OrderRecord* record : records) {
      apart += (record->values - shown_by(expected, *record)) / count;
      squares += record->errors.cwiseAbs2() / (count * count);
    }
    for (std::size_t f = 0; f < conditions_[c].features.size(); ++f) {
      const OrderFeature& feature = conditions_[c].features[f];
      const sim::OutputSpec& output = plant_.outputs[feature.output];
      const bool is_speed = feature.output == angle_;
      const auto at = Eigen::Index(f);
      cells.all.push_back({output.channel, is_speed ? "rad/s" : output.unit,
                           records.front()->about.condition, feature.locked_to,
                           place_of(feature, period_turns_), apart[at], std::sqrt(squares[at])});
    }
  }
  return cells;
}

PushedFeatures OrderTwin::pushed_features(const std::vector<std::size_t>& effects,
                                          const std::vector<double>& values) const {
  const auto states = solved(effects, values);
  if (!states) return {};
  return order_pushes(plant_with(effects, values), terms_, conditions_, records_, *states,
                      {angle_, turning_, period_turns_});
}

std::vector<Twin::Comparison> OrderTwin::compare(const std::vector<std::size_t>& effects,
                                                 const std::vector<double>& values) const {
  const auto states = solved(effects, values);
  if (!states) return {};
  std::vector<Comparison> all;
  for (const OrderRecord& record : records_) {
    const sim::SteadyState& state = (*states)[record.condition];
    for (std::size_t o = 0; o < plant_.outputs.size(); ++o) {
      if (o == angle_) continue;
      const sim::OutputSpec& output = plant_.outputs[o];
      const analysis::PeriodLines& lines = record.measured.outputs[o];
      const double order = 1 / period_turns_;
      const Eigen::Index size = conditions_[record.condition].orders[o];
      Eigen::VectorXd simulated(size);
      for (Eigen::Index k = 1; k <= size; ++k) {
        simulated[k - 1] = with_noise(std::abs(state.outputs[o].shaft_lines[k]), lines.noise[k]);
      }
      all.push_back({record.about.name, output.channel, output.unit, record.about.learned_from, 1,
                     "order of the input shaft", order, order, lines.amplitude.segment(1, size),
                     std::move(simulated)});
    }
  }
  return all;
}

}  // namespace rvbench::bench
