// concealed_effects EFFECTS.json single EFFECT SEED | null SEED | pair SEED [--tried]
// Hides effects in a simulated RV bench that turns in time, lets explain look for them with the
// plant that lacks them, and prints one line: what was hidden, what was answered, whether that is
// right.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "analysis/explain/explanation.hpp"
#include "bench/order_twin.hpp"
#include "sim/draw.hpp"
#include "sim/effect_sites.hpp"
#include "sim/rv_plant.hpp"
#include "sim/steady_state.hpp"
#include "tests/support/rv_campaign.hpp"

using namespace rvbench;
using nlohmann::json;

namespace {

constexpr double below_strongest_line = 0.1;  // 20 dB
constexpr double over_scatter = 3;            // of the friction from record to record
constexpr int sizings = 3;                    // each as large as the one before came out too small
const sim::NaturalScales natural{2.5, 1e-3, 120};

/// An effect as it is hidden.
struct Hidden {
  json about;
  std::string name;
  sim::EffectSite site;
  sim::Parameters parameters;
};

struct Shown {
  double strongest_mean_Nm = 0;
  Eigen::MatrixXcd lines;  ///< of torque: orders x conditions; the last rows follow time
  Eigen::VectorXd means_Nm;
};

// How the torque of a plant that turns steadily looks under the matrix's corners.
std::optional<Shown> shown_by(const sim::PlantSpec& plant) {
  constexpr int orders = 2200;
  const auto made = sim::SteadyPlant::make(plant);
  if (!std::holds_alternative<sim::SteadyPlant>(made)) return std::nullopt;
  const test::RvMatrix matrix;
  const auto count = Eigen::Index(matrix.speeds_rpm.size() * matrix.loads_pct.size());
  Shown shown{0, Eigen::MatrixXcd::Zero(orders + 8, count), Eigen::VectorXd(count)};
  Eigen::Index at = 0;
  for (const double speed_rpm : matrix.speeds_rpm) {
    for (const double load_pct : matrix.loads_pct) {
      const Eigen::Vector2d inputs(speed_rpm / 60 * 2, load_pct / 100 * 167);
      const auto state = std::get<sim::SteadyPlant>(made).under(inputs, orders);
      if (!std::holds_alternative<sim::SteadyState>(state)) return std::nullopt;
      const sim::SteadyOutput& torque = std::get<sim::SteadyState>(state).outputs[0];
      shown.lines.col(at).segment(1, orders) = torque.shaft_lines.tail(orders);
      const Eigen::Index timed = std::min<Eigen::Index>(torque.timed_lines.size(), 7);
      shown.lines.col(at).segment(orders + 1, timed) = torque.timed_lines.head(timed);
      shown.means_Nm[at++] = torque.mean;
    }
  }
  return shown;
}

// By how many times the effect is too small for what it is to show.
double too_small(const Hidden& hidden, const Shown& without, const Shown& with,
                 const test::RvMatrix& matrix) {
  if (hidden.about.at("shows") == "lines") {
    const double strongest = without.lines.topRows(2201).cwiseAbs().maxCoeff();
    return below_strongest_line * strongest / (with.lines - without.lines).cwiseAbs().maxCoeff();
  }
  const Eigen::VectorXd change = with.means_Nm - without.means_Nm;
  const double scatter_Nm = matrix.friction_scatter * 0.15;  // of the input shaft's friction
  return over_scatter * scatter_Nm / std::sqrt(change.squaredNorm() / double(change.size()));
}

sim::PlantSpec with(const sim::PlantSpec& plant, const Hidden& hidden) {
  return sim::with_effect(plant, hidden.name, hidden.site, hidden.parameters);
}

// Somewhere it may act, of random shape, as large as it is to show.
std::optional<Hidden> hide(const sim::PlantSpec& machine, const json& about, sim::Draw& draw) {
  Hidden hidden{about, about.at("effect"), {}, {}};
  const sim::TermType& type = *sim::standard_terms().find(hidden.name);
  std::vector<sim::EffectSite> sites = sim::sites_of(machine, type);
  std::erase_if(sites, [&](const sim::EffectSite& site) {
    const std::string where = sim::describe(site);
    return (about.contains("where") && where != about.at("where")) ||
           (about.contains("not_on") &&
            where == std::string(about.at("not_on")) + " against the housing");
  });
  const auto without = shown_by(machine);
  const test::RvMatrix matrix;
  while (!sites.empty()) {
    const auto at = static_cast<std::size_t>(draw.uniform(0, double(sites.size())));
    hidden.site = sites[at];
    sites.erase(sites.begin() + std::ptrdiff_t(at));
    for (const sim::ParameterCard& card : type.parameters) {
      double value = card.start * natural_scale(card.unit, natural) * draw.within_factor(1.3);
      if (card.unit == sim::UnitKind::angle) value = draw.phase_rad();
      if (card.name == "frequency" && about.contains("frequency_Hz")) {
        value = about.at("frequency_Hz");
      }
      hidden.parameters[card.name] = {value, std::string(unit_of(card.unit, sim::Motion::rotation)),
                                      0};
    }
    std::optional<Shown> shown;
    for (int i = 0; i < sizings; ++i) {
      shown = shown_by(with(machine, hidden));
      if (!shown) break;
      const double factor = too_small(hidden, *without, *shown, matrix);
      if (!std::isfinite(factor)) {
        shown.reset();
        break;
      }
      for (const sim::ParameterCard& card : type.parameters) {
        const bool is_size = &card == &type.parameters.front() ||
                             (card.name == "sine" && type.parameters.front().name == "cosine");
        if (is_size) hidden.parameters[card.name].value *= factor;
      }
    }
    if (shown) return hidden;
  }
  return std::nullopt;
}

std::set<std::string> names_of(const analysis::ExplainedEffect& effect) {
  std::set<std::string> names(effect.one_of.begin(), effect.one_of.end());
  names.insert(effect.name);
  return names;
}

// Its own name, or a class that holds it; what may hide, also by nothing or by a mimic's class.
bool names(const analysis::ExplainedEffect& said, const Hidden& hidden) {
  return names_of(said).contains(hidden.name);
}

bool is_mimic(const analysis::ExplainedEffect& said, const Hidden& hidden) {
  const auto mimics = hidden.about.value("mimics", std::vector<std::string>());
  const auto all = names_of(said);
  return std::ranges::any_of(mimics, [&](const std::string& m) { return all.contains(m); });
}

// right; wrong: a name that is not meant; missed: nothing named
std::string judged(const analysis::Explanation& said, const std::vector<Hidden>& hidden) {
  if (hidden.empty()) {
    return said.verdict == analysis::ExplainVerdict::null ? "right" : "false_alarm";
  }
  std::size_t found = 0;
  for (const Hidden& h : hidden) {
    const bool is_named = std::ranges::any_of(
        said.effects, [&](const auto& e) { return names(e, h) || is_mimic(e, h); });
    const bool hides = h.about.value("may_hide", false) && said.effects.empty();
    if (is_named || hides) ++found;
  }
  const auto meant = [&](const analysis::ExplainedEffect& e) {
    return std::ranges::any_of(hidden,
                               [&](const Hidden& h) { return names(e, h) || is_mimic(e, h); });
  };
  const bool all_meant = std::ranges::all_of(said.effects, meant);
  if (found == hidden.size() && all_meant && said.effects.size() <= hidden.size()) return "right";
  return all_meant ? "missed" : "wrong";
}

std::string said_in_short(const analysis::Explanation& said) {
  std::string text = to_string(said.verdict);
  for (const auto& effect : said.effects) {
    text += " " + effect.name;
    if (!effect.one_of.empty()) text += fmt::format("|{}", effect.one_of.size());
    if (!effect.parameters.empty()) text += fmt::format("={:.3g}", effect.parameters[0].value);
  }
  return text;
}

void print_tried(const bench::Twin& twin, const analysis::Selection& found) {
  const auto print = [&](const analysis::Trial& t) {
    const analysis::Candidate& c = twin.library()[t.effect()];
    std::cout << fmt::format("  {} ({}): cost {:.1f}, gains {:.1f} +- {:.1f}, p {:.2g}: {}\n",
                             c.name, c.where, t.fit.cost, t.over_before.delta, t.over_before.se,
                             t.p_value, t.refused.empty() ? "passes" : t.refused);
  };
  std::cout << fmt::format("  base: cost {:.1f} of {} values\n", found.base.cost,
                           found.base.residuals.size());
  for (const analysis::Step& step : found.steps) {
    for (const analysis::Trial& trial : step.tried) print(trial);
    std::cout << "  --\n";
  }
  for (const analysis::Trial& trial : found.last_tried) print(trial);
}

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

int run(std::vector<std::string> args) {
  const bool in_detail = std::erase(args, "--tried") > 0;
  const json all = json::parse(std::ifstream(args.at(0))).at("effects");
  const std::string kind = args.at(1);
  const auto seed = std::stoull(args.back());
  sim::Draw draw(seed * 1000 + 17);
  const sim::PlantSpec nominal = test::with_mesh_error(sim::rv20e_bench());
  sim::PlantSpec machine = test::within_tolerance(nominal, draw.seed(), 1);
  std::vector<json> wanted;
  if (kind == "single") {
    for (const json& about : all) {
      if (about.at("effect") == args.at(2)) wanted.push_back(about);
    }
    if (wanted.empty()) throw std::invalid_argument(args.at(2) + " is not in " + args.at(0));
  } else if (kind == "pair") {
    std::vector<json> open;
    for (const json& about : all) {
      if (!about.value("may_hide", false)) open.push_back(about);
    }
    for (int i = 0; i < 2; ++i) {
      const auto at = static_cast<std::size_t>(draw.uniform(0, double(open.size())));
      wanted.push_back(open[at]);
      open.erase(open.begin() + std::ptrdiff_t(at));
    }
  }
  std::vector<Hidden> hidden;
  std::string truth;
  for (const json& about : wanted) {
    auto one = hide(machine, about, draw);
    if (!one) throw std::runtime_error(about.at("effect").get<std::string>() + ": nowhere to hide");
    machine = with(machine, *one);
    const std::string first = sim::standard_terms().find(one->name)->parameters.front().name;
    truth += fmt::format(" {}={:.3g} ({})", one->name, one->parameters.at(first).value,
                         sim::describe(one->site));
    hidden.push_back(std::move(*one));
  }
  test::RvMatrix matrix;
  matrix.torque_gain = 1 + draw.uniform(-0.02, 0.02);
  matrix.torque_delay_samples = draw.uniform(-1, 1);
  const auto campaign = test::rv_campaign(machine, draw.seed(), matrix);
  const double start_s = now_s();
  const auto made = bench::OrderTwin::make(nominal, campaign);
  if (const auto* refusal = std::get_if<bench::Refusal>(&made)) {
    throw std::runtime_error(refusal->faults.front().message);
  }
  const analysis::Explanation said = analysis::explain(*std::get<0>(made));
  std::cout << fmt::format("{}{} seed {}: {} | hidden:{} | said: {} | self-null {} | {:.1f} s\n",
                           kind, kind == "single" ? " " + args.at(2) : "", seed,
                           judged(said, hidden), truth.empty() ? " nothing" : truth,
                           said_in_short(said), said.self_null.found.size(), now_s() - start_s);
  if (in_detail) print_tried(*std::get<0>(made), said.selection);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 4)
      throw std::invalid_argument("EFFECTS.json single EFFECT SEED | null SEED | pair SEED");
    return run({argv + 1, argv + argc});
  } catch (const std::exception& problem) {
    std::cerr << "concealed_effects: " << problem.what() << '\n';
    return 2;
  }
}
