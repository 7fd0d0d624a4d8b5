// concealed_effects EFFECTS.json single EFFECT SEED | null SEED | pair SEED [--tried]
// Hides effects in a simulated RV bench that turns in time, lets explain look for them with the
// plant that lacks them, and prints one line: what was hidden, what was answered, whether that is
// right.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "analysis/explain/explanation.hpp"
#include "bench/order_twin.hpp"
#include "sim/draw.hpp"
#include "sim/rv_plant.hpp"
#include "tests/concealed/hiding.hpp"
#include "tests/support/rv_campaign.hpp"

using namespace rvbench;
using nlohmann::json;
using test::Hidden;

namespace {

std::set<std::string> names_of(const analysis::ExplainedEffect& effect) {
  std::set<std::string> names(effect.one_of.begin(), effect.one_of.end());
  names.insert(effect.name);
  return names;
}

// Its own name, that of a mimic, or a class that holds one of them.
bool is_meant(const analysis::ExplainedEffect& said, const Hidden& hidden) {
  auto right = hidden.about.value("mimics", std::vector<std::string>());
  right.push_back(hidden.name);
  const auto all = names_of(said);
  return std::ranges::any_of(right, [&](const std::string& name) { return all.contains(name); });
}

// right; wrong: a name that is not meant; missed: nothing named. Where nothing is hidden, a number
// of the base that has to leave its bounds is no new physics either.
std::string judged(const analysis::Explanation& said, const std::vector<Hidden>& hidden) {
  if (hidden.empty()) {
    const bool is_quiet = said.verdict == analysis::ExplainVerdict::null ||
                          said.verdict == analysis::ExplainVerdict::miscalibrated;
    return is_quiet && said.effects.empty() ? "right" : "false_alarm";
  }
  const bool all_found = std::ranges::all_of(hidden, [&](const Hidden& h) {
    const bool may_hide = !h.shows || h.about.value("may_hide", false);
    return may_hide ||
           std::ranges::any_of(said.effects, [&](const auto& e) { return is_meant(e, h); });
  });
  const bool all_meant = std::ranges::all_of(said.effects, [&](const auto& e) {
    return std::ranges::any_of(hidden, [&](const Hidden& h) { return is_meant(e, h); });
  });
  if (all_found && all_meant && said.effects.size() <= hidden.size()) return "right";
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

// Takes one of them out.
json drawn_from(std::vector<json>& open, sim::Draw& draw) {
  const auto at = static_cast<std::size_t>(draw.uniform(0, double(open.size())));
  json one = std::move(open.at(at));
  open.erase(open.begin() + std::ptrdiff_t(at));
  return one;
}

// Puts into the machine what is asked for: the effect that is named, none, or two that show.
std::vector<Hidden> hide_in(sim::PlantSpec& machine, const std::vector<std::string>& args,
                            sim::Draw& draw) {
  std::vector<json> all = json::parse(std::ifstream(args.at(0))).at("effects");
  const std::size_t count = args.at(1) == "single" ? 1 : args.at(1) == "pair" ? 2 : 0;
  std::erase_if(all, [&](const json& about) {
    if (count == 1) return about.at("effect") != args.at(2);
    return about.at("shows") != "lines" || about.value("may_hide", false);
  });
  std::vector<Hidden> hidden;
  while (hidden.size() < count) {
    if (all.empty()) throw std::runtime_error("nothing that could be hidden");
    auto one = test::hide(machine, drawn_from(all, draw), draw);
    if (!one || (count == 2 && !one->shows)) continue;
    machine = test::with(machine, *one);
    hidden.push_back(std::move(*one));
  }
  return hidden;
}

std::string truth_of(const std::vector<Hidden>& hidden) {
  std::string truth;
  for (const Hidden& one : hidden) {
    const std::string first = sim::standard_terms().find(one.name)->parameters.front().name;
    truth += fmt::format(" {}={:.3g} ({}{})", one.name, one.parameters.at(first).value,
                         sim::describe(one.site), one.shows ? "" : ", does not show");
  }
  return truth.empty() ? " nothing" : truth;
}

int run(std::vector<std::string> args) {
  const bool in_detail = std::erase(args, "--tried") > 0;
  const auto seed = std::stoull(args.back());
  sim::Draw draw(seed * 1000 + 17);
  const sim::PlantSpec nominal = test::with_mesh_error(sim::rv20e_bench());
  sim::PlantSpec machine = test::within_tolerance(nominal, draw.seed(), 1);
  const std::vector<Hidden> hidden = hide_in(machine, args, draw);
  test::RvMatrix matrix;
  matrix.torque_gain = 1 + draw.uniform(-0.02, 0.02);
  matrix.torque_delay_samples = draw.uniform(-1, 1);
  const auto campaign = test::rv_campaign(machine, draw.seed(), matrix);
  const double start_s = now_s();
  const auto made = bench::OrderTwin::make(nominal, campaign);
  if (const auto* refusal = std::get_if<bench::Refusal>(&made)) {
    throw std::runtime_error(
        fmt::format("{} | hidden:{}", refusal->faults.front().message, truth_of(hidden)));
  }
  const analysis::Explanation said = analysis::explain(*std::get<0>(made));
  args.erase(args.begin());
  std::cout << fmt::format("{}: {} | hidden:{} | said: {} | self-null {} | {:.1f} s\n",
                           fmt::join(args, " "), judged(said, hidden), truth_of(hidden),
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
