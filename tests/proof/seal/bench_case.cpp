#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>

#include "tests/proof/seal/bench_files.hpp"
#include "tests/proof/seal/bench_lines.hpp"
#include "tests/proof/seal/noise.hpp"
#include "tests/proof/seal/sealed_case.hpp"
#include "tests/proof/seal/write_text.hpp"

namespace seal {
namespace {

using nlohmann::json;

constexpr double output_turns = 4.5;
constexpr int repeats = 3;
constexpr int sizings = 2;  // each as large as the one before came out too small
// What mean torques differ by from record to record; friction of 0.15 N·m as on the drawing.
const double scatter_Nm = Nuisance().friction_scatter * 0.15;
constexpr double least_noise_Nm = 2e-5;  // of the best electronics

const std::map<std::string, HiddenInBench (*)(const BenchNumbers&, Draw&)> all_effects{
    {"brake_ripple", brake_ripple},
    {"cage_slip", cage_slip},
    {"crank_eccentricity", crank_eccentricity},
    {"external_force", external_force},
    {"five_arms", five_arms},
    {"gear_eccentricity", gear_eccentricity},
    {"inverter_ripple", inverter_ripple},
    {"load_friction", load_friction},
    {"magnetic_poles", magnetic_poles},
    {"mains_hum", mains_hum},
    {"mesh_stiffness_variation", mesh_stiffness_variation},
    {"misalignment", misalignment},
    {"oil_whirl", oil_whirl},
    {"pin_ripple", pin_ripple},
    {"rotor_bar", rotor_bar},
    {"speed_modulation", speed_modulation},
    {"tooth_damage", tooth_damage},
    {"torsional_mode", torsional_mode},
    {"transmission_error", transmission_error}};

struct Hidden {
  HiddenInBench effect;
  double size = 0;
  Visibility seen;
};

// The plant as somebody drew it who does not know of the effect.
json without(json plant, const std::vector<std::string>& parameters) {
  for (json& term : plant.at("terms")) {
    for (const std::string& name : parameters) term.at("parameters").erase(name);
  }
  return plant;
}

// What a machine does without though nothing of the kind is hidden, lest a number that its plant
// file lacks gives away what is. Something stays that excites the meshes.
std::vector<std::string> does_without(const std::vector<std::string>& left_out,
                                      const std::vector<std::string>& needed, Draw& draw) {
  const std::vector<std::string> profile{"profile_error", "profile_phase"},
      stiffness{"stiffness_ripple", "stiffness_ripple_phase"};
  std::vector<std::string> lacks;
  const bool has_all = std::ranges::find(left_out, profile.front()) == left_out.end() &&
                       std::ranges::find(left_out, stiffness.front()) == left_out.end();
  if (has_all && draw.one_in(2)) lacks = draw.one_in(2) ? profile : stiffness;
  if (draw.one_in(3)) lacks.emplace_back("ripple");
  std::erase_if(lacks, [&](const std::string& name) {
    return std::ranges::find(needed, name) != needed.end();
  });
  return lacks;
}

// As large as it is to show: so far below the strongest line, or, of one in means, so far above
// what records differ by.
Hidden sized(BenchSight& sight, HiddenInBench effect, const CasePlan& plan) {
  Hidden hidden{std::move(effect), 0, {}};
  hidden.size = hidden.effect.size;
  for (int i = 0; i <= sizings; ++i) {
    hidden.seen = sight.of(hidden.effect, hidden.size);
    if (!(hidden.seen.line_Nm > 0)) throw std::runtime_error(hidden.effect.name + " does nothing");
    if (i == sizings) break;
    const double wanted_Nm =
        hidden.effect.in_means ? scatter_Nm * std::pow(10, plan.snr_dB / 20)
                               : hidden.seen.strongest_Nm * std::pow(10, -plan.concealment_dB / 20);
    hidden.size = std::min(hidden.size * wanted_Nm / hidden.seen.line_Nm, hidden.effect.most);
  }
  return hidden;
}

// Power of its line over that of noise of 1 N·m in the line's bin, under the middle one of the
// conditions: some hardly show it, and one may lie at a resonance.
double power_over_noise(const Visibility& seen, double slope) {
  std::vector<double> under;
  for (const Visibility::Line& line : seen.under) {
    under.push_back(line.amplitude_Nm * line.amplitude_Nm / 2 * line.length_s /
                    noise_density(slope, line.frequency_Hz, bench_rate_Hz));
  }
  const auto middle = under.begin() + std::ptrdiff_t(under.size() / 2);
  std::ranges::nth_element(under, middle);
  return *middle;
}

Nuisance nuisance_of(const CasePlan& plan, const std::vector<Hidden>& hidden, Draw& draw) {
  Nuisance nuisance;
  const std::string like = plan.kind == "null" ? plan.effects.front() : "usual";
  if (like == "clean") {
    nuisance.noise_slope = 0;
    return nuisance;
  }
  nuisance.torque_gain = 1 + draw.uniform(-0.02, 0.02);
  nuisance.torque_delay_samples = draw.uniform(-1, 1);
  nuisance.noise_slope = draw.uniform(0, like == "usual" ? 1 : 2);
  if (like != "usual") {
    nuisance.warming = draw.uniform(0, 0.02);
    nuisance.drop_outs = static_cast<int>(draw.below(4));
  }
  if (like == "strong") {
    nuisance.line_jitter = draw.uniform(0.02, 0.08);
    nuisance.noise_slope = draw.uniform(1, 2);
    nuisance.noise_Nm *= draw.uniform(2, 10);
  }
  // The one that shows least is to stand so far above it.
  double least_power = std::numeric_limits<double>::infinity();
  for (const Hidden& one : hidden) {
    if (one.effect.in_means) continue;
    least_power = std::min(least_power, power_over_noise(one.seen, nuisance.noise_slope));
  }
  if (std::isfinite(least_power)) {
    nuisance.noise_Nm =
        std::max(least_noise_Nm, std::sqrt(least_power / std::pow(10, plan.snr_dB / 10)));
  }
  return nuisance;
}

json answer_of(const Hidden& hidden, const Nuisance& nuisance) {
  const Visibility& seen = hidden.seen;
  json answer{{"name", hidden.effect.name},           {"also", hidden.effect.also},
              {"bodies", hidden.effect.bodies},       {"anywhere", hidden.effect.anywhere},
              {"parameter", hidden.effect.parameter}, {"value", hidden.size}};
  if (hidden.effect.in_means) {
    answer["snr_dB"] = 20 * std::log10(seen.line_Nm / scatter_Nm);
    return answer;
  }
  answer["snr_dB"] = 10 * std::log10(power_over_noise(seen, nuisance.noise_slope) /
                                     std::pow(nuisance.noise_Nm, 2));
  answer["concealment_dB"] = 20 * std::log10(seen.strongest_Nm / seen.line_Nm);
  return answer;
}

}  // namespace

json seal_bench(const CasePlan& plan, Draw& draw, const std::filesystem::path& plants,
                const std::filesystem::path& folder) {
  const json drawing = bench_drawing(plants);
  std::vector<std::string> left_out, needed;
  std::vector<HiddenInBench> chosen;
  if (plan.kind != "null") {
    for (const std::string& name : plan.effects) {
      chosen.push_back(all_effects.at(name)(numbers_of(drawing), draw));
      const auto& own = chosen.back().without;
      left_out.insert(left_out.end(), own.begin(), own.end());
      const auto& needs = chosen.back().needs;
      needed.insert(needed.end(), needs.begin(), needs.end());
    }
  }
  const json nominal = without(without(drawing, left_out), does_without(left_out, needed, draw));
  const json machine = as_built(nominal, draw);
  std::vector<Hidden> hidden;
  if (!chosen.empty()) {
    BenchSight sight(machine, output_turns);
    for (HiddenInBench& effect : chosen) hidden.push_back(sized(sight, std::move(effect), plan));
  }
  const Nuisance nuisance = nuisance_of(plan, hidden, draw);
  const auto records = run_bench(numbers_of(machine), bench_matrix(repeats), output_turns, nuisance,
                                 draw.seed(), [&] {
                                   std::vector<std::unique_ptr<BenchEffect>> acting;
                                   for (const Hidden& one : hidden) {
                                     acting.push_back(one.effect.make(one.size));
                                   }
                                   return acting;
                                 });
  write_recording(folder / "recording.h5", records);
  write_text(folder / "plant.json", nominal.dump(2) + '\n');
  json answer{{"effects", json::array()}, {"noise_Nm", nuisance.noise_Nm}};
  for (const Hidden& one : hidden) answer["effects"].push_back(answer_of(one, nuisance));
  return answer;
}

}  // namespace seal
