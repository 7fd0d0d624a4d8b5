#include "tests/concealed/hiding.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "sim/named.hpp"
#include "sim/rv_plant.hpp"
#include "sim/steady_state.hpp"
#include "tests/support/rv_campaign.hpp"

namespace rvbench::test {
namespace {

constexpr double below_strongest_line = 0.1;     // 20 dB
constexpr double over_scatter = 3;               // of the torque's mean from record to record
constexpr double most_over_friction = 1;         // of the input shaft's: more would be seen by hand
constexpr double most_over_usual_in_lines = 30;  // of what an effect starts its fits with
constexpr double most_over_usual_in_means = 3;   // likewise: it has to let the shaft start
constexpr int sizings = 4;  // each as large as the one before came out too small
constexpr int orders = 2200;
constexpr Eigen::Index most_rhythms = 8;
constexpr double tolerance_spreads = 2;
const sim::NaturalScales of_input_shaft{2.5, 1e-3, 120};

struct Shown {
  Eigen::MatrixXcd lines;  ///< of torque: orders, then what follows time, x conditions
  Eigen::VectorXd means_Nm;
};

// How the torque of a plant that turns steadily looks under the matrix's corners.
std::optional<Shown> shown_by(const sim::PlantSpec& plant) {
  const auto made = sim::SteadyPlant::make(plant);
  if (!std::holds_alternative<sim::SteadyPlant>(made)) return std::nullopt;
  const auto& steady = std::get<sim::SteadyPlant>(made);
  const sim::PeriodOrders lines = steady.orders_up_to(orders);
  const RvMatrix matrix;
  const auto count = Eigen::Index(matrix.speeds_rpm.size() * matrix.loads_pct.size());
  Shown shown{Eigen::MatrixXcd::Zero(orders + most_rhythms, count), Eigen::VectorXd(count)};
  Eigen::Index at = 0;
  for (const double speed_rpm : matrix.speeds_rpm) {
    for (const double load_pct : matrix.loads_pct) {
      const auto state = steady.under(rv_inputs(speed_rpm, load_pct), lines);
      if (!std::holds_alternative<sim::SteadyState>(state)) return std::nullopt;
      const sim::SteadyOutput& torque = std::get<sim::SteadyState>(state).outputs[0];
      shown.lines.col(at).head(orders) = torque.shaft_lines.tail(orders);
      const Eigen::Index timed = std::min(torque.timed_lines.size(), most_rhythms);
      shown.lines.col(at).segment(orders, timed) = torque.timed_lines.head(timed);
      shown.means_Nm[at++] = torque.mean;
    }
  }
  return shown;
}

double rms(const Eigen::VectorXd& x) { return std::sqrt(x.squaredNorm() / double(x.size())); }

/// A machine before anything is hidden in it.
class Bare {
 public:
  explicit Bare(const sim::PlantSpec& machine) : machine_(machine), shown_(*shown_by(machine)) {
    for (const sim::TermSpec& term : machine.terms) {
      if (term.name == "shaft_friction") friction_Nm_ = term.parameters.at("level").value;
    }
    scatter_Nm_ = RvMatrix().friction_scatter * friction_Nm_;
  }

  double too_small_in_lines(const Shown& with) const {
    return below_strongest_line * shown_.lines.cwiseAbs().maxCoeff() /
           (with.lines - shown_.lines).cwiseAbs().maxCoeff();
  }

  double too_small_in_means(const Shown& with) {
    const double left_Nm = rms(calibrated(with.means_Nm - shown_.means_Nm));
    return over_scatter * scatter_Nm_ / left_Nm;
  }

  double too_large(const Shown& with) const {
    return rms(with.means_Nm - shown_.means_Nm) / (most_over_friction * friction_Nm_);
  }

 private:
  // What remains of a change of the means once every known number has moved as far as it pays.
  Eigen::VectorXd calibrated(const Eigen::VectorXd& change_Nm) {
    if (per_spread_.size() == 0) find_slopes();
    const double error_Nm = scatter_Nm_ / std::sqrt(double(RvMatrix().repeats));
    const Eigen::MatrixXd j = per_spread_ / error_Nm;
    const Eigen::MatrixXd information =
        j.transpose() * j + Eigen::MatrixXd::Identity(j.cols(), j.cols());
    return change_Nm - per_spread_ * information.ldlt().solve(j.transpose() * change_Nm / error_Nm);
  }

  void find_slopes() {
    sim::PlantSpec moved = machine_;
    std::vector<Eigen::VectorXd> columns;
    for (const sim::PlacedQuantity& placed : sim::quantities(moved)) {
      const double tolerance = placed.quantity->tolerance_pct / 100;
      if (!std::isfinite(tolerance) || tolerance == 0) continue;
      const double value = placed.quantity->value;
      placed.quantity->value = value * (1 + tolerance / tolerance_spreads);
      columns.push_back(shown_by(moved)->means_Nm - shown_.means_Nm);
      placed.quantity->value = value;
    }
    per_spread_.resize(shown_.means_Nm.size(), Eigen::Index(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i) per_spread_.col(Eigen::Index(i)) = columns[i];
  }

  const sim::PlantSpec& machine_;
  Shown shown_;
  double friction_Nm_ = 0, scatter_Nm_ = 0;
  Eigen::MatrixXd per_spread_;  // of the means: conditions x known numbers
};

// Where effects.json lets it act.
std::vector<sim::EffectSite> sites_of(const sim::PlantSpec& machine, const Hidden& hidden) {
  std::vector<sim::EffectSite> sites =
      sim::sites_of(machine, *sim::standard_terms().find(hidden.name));
  std::erase_if(sites, [&](const sim::EffectSite& site) {
    const std::string where = sim::describe(site);
    const auto on = [&](const char* key) { return hidden.about.at(key).get<std::string>(); };
    return (hidden.about.contains("where") && where != on("where")) ||
           (hidden.about.contains("not_on") && where == on("not_on") + " against the housing");
  });
  return sites;
}

// A slow body goes with large forces and small ways.
sim::NaturalScales natural_at(const sim::PlantSpec& machine, const sim::EffectSite& site) {
  const auto steady = sim::SteadyPlant::make(machine);
  const Eigen::VectorXd& turns = std::get<sim::SteadyPlant>(steady).turns_per_period();
  const auto turns_of = [&](const std::string& name) {
    const int body = sim::index_of(machine.bodies, name);
    return body < 0 ? 0 : turns[body];
  };
  const double against = std::abs(turns_of(site.body_a) - turns_of(site.body_b));
  const double ratio = (against > 0 ? against : turns_of(site.body_a)) / turns_of("input_shaft");
  return {of_input_shaft.force / ratio, of_input_shaft.coordinate * ratio,
          of_input_shaft.speed * ratio};
}

sim::Parameters random_shape(const sim::PlantSpec& machine, const Hidden& hidden, sim::Draw& draw) {
  const sim::NaturalScales natural = natural_at(machine, hidden.site);
  sim::Parameters parameters;
  for (const sim::ParameterCard& card : sim::standard_terms().find(hidden.name)->parameters) {
    double value = card.start * natural_scale_at(machine, hidden.site, card.unit, natural) *
                   draw.within_factor(1.3);
    if (card.unit == sim::UnitKind::angle) value = draw.phase_rad();
    if (card.name == "frequency" && hidden.about.contains("frequency_Hz")) {
      value = hidden.about.at("frequency_Hz");
    }
    parameters[card.name] = {std::clamp(value, card.min, card.max),
                             unit_at(machine, hidden.site, card.unit), 0};
  }
  return parameters;
}

double& size_of(Hidden& hidden) {
  return hidden.parameters[sim::standard_terms().find(hidden.name)->parameters.front().name].value;
}

double over_usual(const sim::PlantSpec& machine, Hidden& hidden) {
  const sim::ParameterCard& card = sim::standard_terms().find(hidden.name)->parameters.front();
  return std::abs(size_of(hidden) /
                  (card.start * natural_scale_at(machine, hidden.site, card.unit,
                                                 natural_at(machine, hidden.site))));
}

// @return false if it does nothing there
bool give_size(const sim::PlantSpec& machine, Bare& bare, Hidden& hidden) {
  const bool in_lines = hidden.about.at("shows") == "lines";
  for (int i = 0; i < sizings; ++i) {
    const auto shown = shown_by(with(machine, hidden));
    if (!shown) return false;
    const double usual = over_usual(machine, hidden);
    const double wanted =
        in_lines ? bare.too_small_in_lines(*shown) : bare.too_small_in_means(*shown);
    const double most =
        in_lines ? most_over_usual_in_lines / usual
                 : std::min(most_over_usual_in_means / usual, 1 / bare.too_large(*shown));
    if (!std::isfinite(most)) return false;
    hidden.shows = wanted <= most;
    size_of(hidden) *= std::min(wanted, most);
  }
  return true;
}

}  // namespace

sim::PlantSpec with(const sim::PlantSpec& plant, const Hidden& hidden) {
  return sim::with_effect(plant, hidden.name, hidden.site, hidden.parameters);
}

std::optional<Hidden> hide(const sim::PlantSpec& machine, const nlohmann::json& about,
                           sim::Draw& draw) {
  Hidden hidden{about, about.at("effect"), {}, {}};
  Bare bare(machine);
  std::vector<sim::EffectSite> sites = sites_of(machine, hidden);
  while (!sites.empty()) {
    const auto at = static_cast<std::size_t>(draw.uniform(0, double(sites.size())));
    hidden.site = sites[at];
    sites.erase(sites.begin() + std::ptrdiff_t(at));
    hidden.parameters = random_shape(machine, hidden, draw);
    if (give_size(machine, bare, hidden)) return hidden;
  }
  return std::nullopt;
}

}  // namespace rvbench::test
