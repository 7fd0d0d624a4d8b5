#include "bench/order_pushes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "bench/order_choice.hpp"
#include "sim/named.hpp"

namespace rvbench::bench {
namespace {

using analysis::LockedTo;

constexpr double one_side = 1e-3;  // of what the two sides differ by

// What a condition's records show on average.
struct Shown {
  Eigen::VectorXd value, error, floor;
};

std::optional<Shown> shown_under(std::size_t condition, const std::vector<OrderRecord>& records) {
  Shown shown;
  double count = 0;
  for (const OrderRecord& record : records) {
    if (record.condition != condition || !record.about.learned_from) continue;
    if (count == 0) shown.value = shown.error = shown.floor = 0 * record.values;
    shown.value += record.values;
    shown.error += record.errors.cwiseAbs2();
    shown.floor += record.noise.unaryExpr([](double noise) { return with_noise(0, noise); });
    ++count;
  }
  if (count == 0) return std::nullopt;
  return Shown{shown.value / count, shown.error.cwiseSqrt() / count, shown.floor / count};
}

// An effort between two bodies that turn alike.
struct Transducer {
  std::size_t output = 0;
  int left = 0, right = 0;
  bool parts_sides = true;  ///< nothing else joins them
};

std::optional<Transducer> find_transducer(const sim::PlantSpec& plant,
                                          const sim::SteadyState& state) {
  for (std::size_t o = 0; o < plant.outputs.size(); ++o) {
    const bool is_torque = plant.outputs[o].unit == "N·m";
    if (plant.outputs[o].kind != sim::OutputKind::effort || !is_torque) continue;
    const sim::TermSpec& term = *plant.find_term(plant.outputs[o].of);
    int a = sim::index_of(plant.bodies, term.body_a);
    int b = sim::index_of(plant.bodies, term.body_b);
    if (a < 0 || b < 0 || state.speed_rad_s[a] != state.speed_rad_s[b]) continue;
    const double taken_from_a = state.outputs[o].mean * plant.outputs[o].gain.value;
    if (taken_from_a * state.speed_rad_s[a] < 0) std::swap(a, b);  // left is what drives
    return Transducer{o, a, b};
  }
  return std::nullopt;
}

class Features {
 public:
  Features(const sim::PlantSpec& plant, const sim::SteadyState& state, const ReferenceShaft& shaft)
      : plant_(plant), shaft_(shaft), transducer_(find_transducer(plant, state)) {}

  void add(std::size_t condition, const OrderCondition& under, const Shown& shown,
           const sim::SteadyState& state, const sim::PushResponse& response) {
    if (all_.sites.empty()) name_sites(response.sites);
    const double load = transducer_ ? state.outputs[transducer_->output].mean : 0;
    auto answer = response.lines.begin();
    for (std::size_t f = 0; f < under.features.size(); ++f) {
      const OrderFeature& feature = under.features[f];
      if (feature.locked_to == LockedTo::nothing) continue;
      const bool is_order = feature.locked_to == LockedTo::shaft;
      const auto at = Eigen::Index(f);
      all_.lines.push_back(
          {plant_.outputs[feature.output].channel, condition, feature.locked_to, feature.order,
           is_order ? feature.order / shaft_.period_turns : feature.frequency_Hz, load,
           shown.value[at], shown.error[at], shown.floor[at],
           predicted(state, feature, under.length_s), answer->row(Eigen::Index(feature.output))});
      ++answer;
    }
    if (transducer_ && transducer_->parts_sides) add_means(under, shown, state, response);
  }

  PushedFeatures told() && { return std::move(all_); }

 private:
  void name_sites(const std::vector<sim::PushSite>& sites) {
    for (const sim::PushSite& site : sites) {
      const bool turns = plant_.motion_of(site.on) == sim::Motion::rotation;
      all_.sites.push_back({site.name, site.on, turns ? "N·m" : "N", site.is_joint});
    }
  }

  void add_means(const OrderCondition& under, const Shown& shown, const sim::SteadyState& state,
                 const sim::PushResponse& response) {
    const Eigen::Index torque = mean_of(under, transducer_->output);
    const Eigen::Index speed = mean_of(under, shaft_.output);
    const double speed_rad_s =
        std::abs(plant_.outputs[shaft_.output].gain.value * state.speed_rad_s[shaft_.body]);
    const double here_rad_s = std::abs(state.speed_rad_s[transducer_->left]);
    // A force on each body, with its rotation, as a torque at the transducer.
    Eigen::Matrix2Xd gains(2, response.means.cols());
    gains.row(0) = response.means.row(Eigen::Index(transducer_->output));
    gains.row(1) = response.slowest_rad_s * speed_rad_s / state.slowest_rad_s;
    for (Eigen::Index body = 0; body < gains.cols(); ++body) {
      const double body_rad_s = state.speed_rad_s[body];
      gains.col(body) *= body_rad_s == 0 ? 0 : here_rad_s / body_rad_s;
    }
    if (all_.means.empty() && !find_sides(gains)) {
      transducer_->parts_sides = false;
      return;
    }
    const double torque_Nm = state.outputs[transducer_->output].mean;
    const double forward = torque_Nm < 0 ? -1 : 1;  // a load is what is carried, whichever way
    Eigen::Matrix2d sides;
    sides << gains.col(transducer_->left), -gains.col(transducer_->right);
    sides.row(0) *= forward;
    all_.means.push_back(
        {{forward * (shown.value[torque] - torque_Nm), shown.value[speed] - speed_rad_s},
         {shown.error[torque], shown.error[speed]},
         sides,
         std::abs(torque_Nm),
         speed_rad_s});
  }

  // Where torque and speed answer a constant force alike, it acts on one side.
  bool find_sides(const Eigen::Matrix2Xd& gains) {
    const auto ratio = [&](Eigen::Index body) { return gains(0, body) / gains(1, body); };
    const double of_left = ratio(transducer_->left), of_right = ratio(transducer_->right);
    const double near = one_side * std::abs(of_left - of_right);
    std::vector<std::string> left, right;
    for (Eigen::Index body = 0; body < gains.cols(); ++body) {
      if (gains(1, body) == 0) continue;
      const bool is_left = std::abs(ratio(body) - of_left) <= near;
      if (!is_left && !(std::abs(ratio(body) - of_right) <= near)) return false;
      (is_left ? left : right).push_back(plant_.bodies[std::size_t(body)].name);
    }
    all_.left = std::move(left);
    all_.right = std::move(right);
    all_.transducer = plant_.outputs[transducer_->output].channel;
    return true;
  }

  static Eigen::Index mean_of(const OrderCondition& under, std::size_t output) {
    const auto at = std::ranges::find_if(under.features, [&](const OrderFeature& feature) {
      return feature.locked_to == LockedTo::nothing && feature.output == output;
    });
    return at - under.features.begin();
  }

  const sim::PlantSpec& plant_;
  ReferenceShaft shaft_;
  std::optional<Transducer> transducer_;
  PushedFeatures all_;
};

std::vector<double> frequencies_of(const OrderCondition& condition, const sim::SteadyState& state) {
  std::vector<double> all_Hz;
  for (const OrderFeature& feature : condition.features) {
    if (feature.locked_to == LockedTo::nothing) continue;
    all_Hz.push_back(feature.locked_to == LockedTo::shaft ? feature.order * state.period_Hz
                                                          : feature.frequency_Hz);
  }
  return all_Hz;
}

}  // namespace

PushedFeatures order_pushes(const sim::PlantSpec& plant, const sim::TermLibrary& library,
                            const std::vector<OrderCondition>& conditions,
                            const std::vector<OrderRecord>& records,
                            const std::vector<sim::SteadyState>& states,
                            const ReferenceShaft& shaft) {
  const auto made = sim::SteadyPlant::make(plant, library);
  const auto* steady = std::get_if<sim::SteadyPlant>(&made);
  if (steady == nullptr) return {};
  const sim::PeriodOrders orders = steady->orders_up_to(highest_order(conditions));
  Features features(plant, states.front(), shaft);
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    const auto shown = shown_under(c, records);
    if (!shown) continue;
    const auto response = steady->response(states[c], conditions[c].inputs, orders,
                                           frequencies_of(conditions[c], states[c]));
    if (!response) continue;  // nothing can be said of it
    features.add(c, conditions[c], *shown, states[c], *response);
  }
  return std::move(features).told();
}

}  // namespace rvbench::bench
