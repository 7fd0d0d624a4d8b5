#include "bench/order_twin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include "analysis/explain/pressed.hpp"
#include "bench/order_between.hpp"
#include "bench/order_cells.hpp"
#include "bench/order_choice.hpp"
#include "bench/order_errors.hpp"
#include "bench/order_pushes.hpp"
#include "hal/types/parallel_for.hpp"
#include "hal/types/units.hpp"
#include "sim/mains.hpp"
#include "sim/named.hpp"
#include "sim/plant_check.hpp"

namespace rvbench::bench {

using analysis::LockedTo;

TwinOrRefusal OrderTwin::make(sim::PlantSpec plant, const Campaign& campaign,
                              const sim::TermLibrary& library) {
  if (auto faults = sim::check_plant(plant, library); !faults.empty()) {
    return Refusal{std::move(faults), false};
  }
  std::unique_ptr<OrderTwin> twin(new OrderTwin(std::move(plant), library));
  auto seen = order_campaign(twin->plant_, campaign, library);
  if (auto* refusal = std::get_if<Refusal>(&seen)) return std::move(*refusal);
  twin->seen_ = std::get<OrderCampaign>(std::move(seen));
  twin->family_.emplace(twin->plant_, twin->scales(), library);
  twin->base_ = twin->family_->base();
  const std::vector<CandidateProbe> probes = twin->probe();
  choose_features(twin->plant_, twin->seen_.records, probes, twin->seen_.period_turns,
                  twin->seen_.conditions);
  for (OrderRecord& record : twin->seen_.records) {
    read_features(twin->seen_.conditions[record.condition], record);
  }
  twin->scatter_ =
      scatter_of(twin->seen_.conditions, twin->plant_.outputs.size(), twin->seen_.records);
  find_errors(twin->seen_.conditions, twin->scatter_, twin->seen_.records);
  group_candidates(*twin->family_, twin->marks_of(probes));
  twin->cut_units();
  return std::unique_ptr<Twin>(std::move(twin));
}

ParameterScales OrderTwin::scales() const {
  double torque = 0, speed = 0, count = 0;
  for (const OrderRecord& record : seen_.records) {
    if (!record.about.learned_from) continue;
    for (std::size_t o = 0; o < plant_.outputs.size(); ++o) {
      double& sum = o == seen_.angle ? speed : torque;
      sum += std::pow(record.measured.outputs[o].mean, 2);
    }
    ++count;
  }
  const auto others = static_cast<double>(plant_.outputs.size()) - 1;
  const double force = std::sqrt(torque / count / std::max(others, 1.0));
  const Eigen::VectorXd& speeds = seen_.conditions.front().nominal.speed_rad_s;
  std::vector<double> turns;
  for (const double body_rad_s : speeds) turns.push_back(body_rad_s / speeds[seen_.turning]);
  return {{force, 1e-3, std::sqrt(speed / count)},
          1e-3,
          force,
          {sim::mains_frequencies_Hz.begin(), sim::mains_frequencies_Hz.end()},
          std::move(turns),
          false,
          strong_lines_Hz(seen_.conditions)};
}

// What each candidate of usual size changes of the first record of each probed condition, in
// standard errors.
Eigen::MatrixXd OrderTwin::marks_of(const std::vector<CandidateProbe>& probes) const {
  std::vector<Eigen::VectorXd> columns(probes.size());
  Eigen::Index rows = 0;
  const std::vector<std::size_t> probed = probed_conditions(seen_.conditions);
  for (std::size_t p = 0; p < probed.size(); ++p) {
    const auto record = std::ranges::find(seen_.records, probed[p], &OrderRecord::condition);
    const OrderCondition& condition = seen_.conditions[probed[p]];
    const Eigen::VectorXd before =
        shown_by(features_of(condition.nominal, condition), condition, *record);
    rows += before.size();
    for (std::size_t i = 0; i < probes.size(); ++i) {
      Eigen::VectorXd& column = columns[i];
      column.conservativeResizeLike(Eigen::VectorXd::Zero(rows));
      if (!probes[i].fault.empty()) continue;
      column.tail(before.size()) =
          (shown_by(features_of(probes[i].states[p], condition), condition, *record) - before)
              .cwiseQuotient(record->errors);
    }
  }
  Eigen::MatrixXd marks(rows, Eigen::Index(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) marks.col(Eigen::Index(i)) = columns[i];
  return marks;
}

// Whether what moves at a site goes one way under some conditions and the other under others.
bool OrderTwin::reverses(const sim::EffectSite& site) const {
  const int a = sim::index_of(plant_.bodies, site.body_a);
  const int b = sim::index_of(plant_.bodies, site.body_b);
  double slowest = 0, fastest = 0;
  for (const OrderCondition& condition : seen_.conditions) {
    const Eigen::VectorXd& speeds = condition.nominal.speed_rad_s;
    const double speed = speeds[a] - (b < 0 ? 0 : speeds[b]);
    slowest = std::min(slowest, speed);
    fastest = std::max(fastest, speed);
  }
  return slowest < 0 && fastest > 0;
}

std::vector<CandidateProbe> OrderTwin::probe() {
  const std::vector<std::size_t> probed = probed_conditions(seen_.conditions);
  auto probes = probe_candidates(
      *family_, [&](const sim::PlantSpec& plant) { return states_of(plant, probed); });
  for (std::size_t i = 0; i < probes.size(); ++i) {
    if (!probes[i].fault.empty()) family_->cannot_show(i, probes[i].fault);
    if (!family_->gate_of(i).one_way_like.empty() && !reverses(family_->site_of(i))) {
      family_->never_reverses(i);
    }
  }
  return probes;
}

void OrderTwin::cut_units() {
  Eigen::Index at = 0;
  for (const OrderRecord& record : seen_.records) {
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
  const sim::PeriodOrders orders = steady.orders_up_to(highest_order(seen_.conditions));
  std::vector<sim::SteadyState> states;
  for (const std::size_t c : conditions) {
    auto state = steady.under(seen_.conditions[c].inputs, orders, &seen_.conditions[c].nominal);
    if (const auto* fault = std::get_if<hal::ConfigFault>(&state)) return *fault;
    states.push_back(std::get<sim::SteadyState>(std::move(state)));
  }
  return states;
}

std::optional<std::vector<sim::SteadyState>> OrderTwin::solved(
    const std::vector<std::size_t>& effects, const std::vector<double>& values) const {
  std::vector<std::size_t> all(seen_.conditions.size());
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
        : feature.output != seen_.angle
            ? value.real()
            : std::abs(plant_.outputs[seen_.angle].gain.value * state.speed_rad_s[seen_.turning]);
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
  for (std::size_t c = 0; c < seen_.conditions.size(); ++c) {
    features.push_back(features_of((*states)[c], seen_.conditions[c]));
  }
  Eigen::VectorXd apart(units_.back().first + units_.back().size);
  auto unit = units_.begin();
  for (const OrderRecord& record : seen_.records) {
    if (!record.about.learned_from) continue;
    apart.segment(unit->first, unit->size) =
        (record.values -
         shown_by(features[record.condition], seen_.conditions[record.condition], record))
            .cwiseQuotient(record.errors)
            .unaryExpr([&](double r) { return analysis::pressed(r, believable()); });
    ++unit;
  }
  return apart;
}

Twin::Cells OrderTwin::cells(const std::vector<std::size_t>& effects,
                             const std::vector<double>& values) const {
  const auto states = solved(effects, values);
  std::vector<Eigen::VectorXd> expected;
  for (std::size_t c = 0; states && c < seen_.conditions.size(); ++c) {
    expected.push_back(features_of((*states)[c], seen_.conditions[c]));
  }
  Cells cells = order_cells(plant_.outputs, seen_, scatter_, expected);
  if (cells.all.empty()) return cells;
  std::ranges::move(cells_between_orders(plant_, seen_), std::back_inserter(cells.all));
  return cells;
}

PushedFeatures OrderTwin::pushed_features(const std::vector<std::size_t>& effects,
                                          const std::vector<double>& values) const {
  const auto states = solved(effects, values);
  if (!states) return {};
  return order_pushes(plant_with(effects, values), terms_, seen_.conditions, seen_.records, *states,
                      {seen_.angle, seen_.turning, seen_.period_turns});
}

std::vector<Twin::Comparison> OrderTwin::compare(const std::vector<std::size_t>& effects,
                                                 const std::vector<double>& values) const {
  const auto states = solved(effects, values);
  if (!states) return {};
  std::vector<Comparison> all;
  for (const OrderRecord& record : seen_.records) {
    const sim::SteadyState& state = (*states)[record.condition];
    for (std::size_t o = 0; o < plant_.outputs.size(); ++o) {
      if (o == seen_.angle) continue;
      const sim::OutputSpec& output = plant_.outputs[o];
      const analysis::PeriodLines& lines = record.measured.outputs[o];
      const double order = 1 / seen_.period_turns;
      const Eigen::Index size = seen_.conditions[record.condition].orders[o];
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
