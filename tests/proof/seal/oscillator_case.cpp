#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "hal/types/parallel_for.hpp"
#include "tests/proof/seal/noise.hpp"
#include "tests/proof/seal/sealed_case.hpp"
#include "tests/proof/seal/slide_calibration.hpp"
#include "tests/proof/seal/slide_effects/slide_effects.hpp"
#include "tests/proof/seal/slide_records.hpp"
#include "tests/proof/seal/write_text.hpp"

namespace seal {
namespace {

using nlohmann::json;

constexpr double rate_Hz = 250;
constexpr double length_s = 16.384;
constexpr double lowest_Hz = 2, highest_Hz = 28;
constexpr int steps_per_sample = 16;
constexpr double little = 1e-3;  // of a number, for its slope
constexpr int law_rounds = 2;    // a law's way is nearly as large as the law
constexpr int sizings = 3;       // each as large as the one before came out too small
constexpr double two_pi = 2 * std::numbers::pi;

const std::map<std::string, HiddenInSlide (*)(const SlideScales&, Draw&)> all_effects{
    {"coulomb_friction", coulomb_friction},
    {"cubic_stiffness", cubic_stiffness},
    {"looseness", looseness},
    {"nonlinear_damping", nonlinear_damping},
    {"pumped_spring", pumped_spring},
    {"quadratic_stiffness", quadratic_stiffness},
    {"stiffness_hysteresis", stiffness_hysteresis}};

struct Oscillator {
  double mass_kg = 0, stiffness = 0, damping = 0;
};

/// Tones of one size and random phase that repeat after a record.
class Push {
 public:
  Push(double rms_N, Draw& draw) {
    constexpr auto count = static_cast<Eigen::Index>(length_s * rate_Hz) * steps_per_sample * 2;
    samples_ = Eigen::VectorXd::Zero(count);
    const int first = static_cast<int>(lowest_Hz * length_s),
              last = static_cast<int>(highest_Hz * length_s);
    const double each_N = rms_N * std::sqrt(2.0 / (last - first + 1));
    for (int tone = first; tone <= last; ++tone) {
      const double phase = draw.phase_rad();
      for (Eigen::Index i = 0; i < count; ++i) {
        samples_[i] += each_N * std::cos(two_pi * tone * double(i) / double(count) + phase);
      }
    }
  }
  /// @param half_steps  of the integration, from the record's beginning
  double at(Eigen::Index half_steps) const {
    return samples_[(half_steps % samples_.size() + samples_.size()) % samples_.size()];
  }

 private:
  Eigen::VectorXd samples_;
};

json plant_of(const Oscillator& drawn) {
  return {{"plant", "oscillator"},
          {"about", "a mass on a spring that a shaker pushes"},
          {"bodies",
           {{{"name", "mass"},
             {"motion", "translation"},
             {"mass", quantity(drawn.mass_kg, "kg", 10)}}}},
          {"terms",
           {{{"type", "spring"},
             {"body_a", "mass"},
             {"parameters", {{"stiffness", quantity(drawn.stiffness, "N/m", 15)}}}},
            {{"type", "damper"},
             {"body_a", "mass"},
             {"parameters", {{"damping", quantity(drawn.damping, "N·s/m", 50)}}}}}},
          {"inputs",
           {{{"channel", "push"},
             {"unit", "N"},
             {"is", "force"},
             {"body", "mass"},
             {"between_samples", "band_limited"},
             {"offset", quantity(0, "N", "free")}}}},
          {"outputs",
           {{{"channel", "way"},
             {"unit", "m"},
             {"is", "position"},
             {"body", "mass"},
             {"gain", quantity(1, "1", 3)},
             {"offset", quantity(0, "m", "free")},
             {"delay", quantity(0, "s", "free")}}}}};
}

using Effects = std::vector<std::unique_ptr<SlideEffect>>;

// By Runge and Kutta's classical steps; what remembers is asked at each step's beginning. Once
// through the tones before anything is recorded.
Eigen::VectorXd way_of(const Oscillator& machine, const Push& push, const Effects& effects,
                       double delay_s) {
  constexpr double step_s = 1 / rate_Hz / steps_per_sample;
  constexpr auto count = static_cast<Eigen::Index>(length_s * rate_Hz);
  const auto late = static_cast<Eigen::Index>(std::round(delay_s / step_s));
  Eigen::VectorXd shown(count);
  double x = 0, v = 0;
  for (Eigen::Index step = -count * steps_per_sample; step < (count + 1) * steps_per_sample;
       ++step) {
    const Eigen::Index seen = step + late;
    if (seen >= 0 && seen % steps_per_sample == 0 && seen / steps_per_sample < count) {
      shown[seen / steps_per_sample] = x;
    }
    double held_N = 0;
    for (const auto& effect : effects) held_N += effect->force_N(x, v, step_s);
    const auto rate_of = [&](double way, double speed, Eigen::Index half) {
      return (push.at(2 * step + half) - held_N - machine.stiffness * way -
              machine.damping * speed) /
             machine.mass_kg;
    };
    const double a1 = rate_of(x, v, 0);
    const double x2 = x + step_s / 2 * v, v2 = v + step_s / 2 * a1, a2 = rate_of(x2, v2, 1);
    const double x3 = x + step_s / 2 * v2, v3 = v + step_s / 2 * a2, a3 = rate_of(x3, v3, 1);
    const double x4 = x + step_s * v3, v4 = v + step_s * a3, a4 = rate_of(x4, v4, 2);
    x += step_s / 6 * (v + 2 * v2 + 2 * v3 + v4);
    v += step_s / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return shown;
}

// As a drawing has it, and as it was built.
struct Oscillators {
  Oscillator drawn, built;
};

Oscillators draw_oscillators(Draw& draw) {
  const double natural_Hz = draw.uniform(9, 14), ratio = draw.uniform(0.02, 0.05);
  const double mass_kg = draw.within_factor(3);
  const double rate = two_pi * natural_Hz;
  const Oscillator drawn{mass_kg, mass_kg * rate * rate, 2 * ratio * rate * mass_kg};
  return {drawn,
          {drawn.mass_kg * (1 + 0.1 * draw.uniform(-1, 1)),
           drawn.stiffness * (1 + 0.15 * draw.uniform(-1, 1)),
           drawn.damping * (1 + 0.5 * draw.uniform(-1, 1))}};
}

// What pushes a machine, level by level.
class Shaker {
 public:
  explicit Shaker(Draw& draw) {
    for (const double level_N : levels_N) {
      for (int i = 0; i < realisations; ++i) pushes_.emplace_back(level_N, draw);
    }
  }

  std::vector<Eigen::VectorXd> ways_of(const Oscillator& machine,
                                       const std::vector<HiddenSlide>& acting,
                                       double late_s) const {
    std::vector<Eigen::VectorXd> ways(pushes_.size());
    rvbench::parallel_for(pushes_.size(), [&](std::size_t i) {
      Effects effects;
      for (const HiddenSlide& one : acting) effects.push_back(one.effect.make(one.size));
      ways[i] = way_of(machine, pushes_[i], effects, late_s);
    });
    return ways;
  }

  std::vector<SlideRecord> records_of(const Oscillator& machine,
                                      const std::vector<HiddenSlide>& hidden,
                                      const SlideChain& chain, double noise_m, Draw& draw) const {
    const auto ways = ways_of(machine, hidden, chain.delay_s);
    std::vector<SlideRecord> records;
    for (std::size_t i = 0; i < ways.size(); ++i) {
      SlideRecord record{fmt::format("{:g} N", levels_N[i / realisations]), "", {}, {}};
      record.input = Eigen::VectorXd::NullaryExpr(
          ways[i].size(), [&](Eigen::Index k) { return pushes_[i].at(2 * k * steps_per_sample); });
      record.output =
          chain.gain * ways[i] + noise_m * coloured_noise(ways[i].size(), chain.noise_slope, draw);
      records.push_back(std::move(record));
    }
    return records;
  }

 private:
  static constexpr std::array<double, 3> levels_N{2, 5, 10};
  static constexpr int realisations = 2;
  std::vector<Push> pushes_;
};

using Ways = std::vector<Eigen::VectorXd>;

Ways less(Ways ways, const Ways& than) {
  for (std::size_t i = 0; i < ways.size(); ++i) ways[i] -= than[i];
  return ways;
}

// Mass, stiffness, damping, gain, offset and delay.
SlideCalibration calibration_of(const Oscillator& machine, const Shaker& shaker, const Ways& bare) {
  std::vector<Ways> moved{bare, bare};
  for (Eigen::VectorXd& way : moved.back()) way.setOnes();
  for (double Oscillator::*number :
       {&Oscillator::mass_kg, &Oscillator::stiffness, &Oscillator::damping}) {
    Oscillator other = machine;
    other.*number *= 1 + little;
    moved.push_back(less(shaker.ways_of(other, {}, 0), bare));
  }
  moved.push_back(less(shaker.ways_of(machine, {}, 1 / rate_Hz / steps_per_sample), bare));
  return SlideCalibration(moved);
}

// Of rvbench's law, the size that comes nearest to what an effect does.
double value_of(const HiddenSlide& hidden, const Oscillator& machine, const Shaker& shaker,
                const Ways& bare, const SlideCalibration& calibration) {
  if (!hidden.effect.law) return hidden.size;
  double value = hidden.size;
  for (int round = 0; round < law_rounds; ++round) {
    const HiddenSlide law{as_law(hidden.effect), value};
    value *= calibration.times(less(shaker.ways_of(machine, {law}, 0), bare), hidden.change);
  }
  return value;
}

// The effects of a plan, each as far below the way under the strongest push as it is to be.
std::vector<HiddenSlide> hidden_in(const CasePlan& plan, const Oscillator& machine,
                                   const Shaker& shaker, const Ways& bare, const SlideScales& usual,
                                   const SlideChain& chain, Draw& draw) {
  std::vector<HiddenSlide> all;
  if (plan.kind == "null") return all;
  const SlideCalibration calibration = calibration_of(machine, shaker, bare);
  for (const std::string& name : plan.effects) {
    HiddenSlide one{all_effects.at(name)(usual, draw)};
    one.size = one.effect.size * 0.05;
    for (int sizing = 0; sizing < sizings; ++sizing) {
      one.change = less(shaker.ways_of(machine, {one}, 0), bare);
      if (sizing + 1 == sizings) break;
      one.size *=
          std::pow(10, -plan.concealment_dB / 20) * rms(bare.back()) / rms(one.change.back());
    }
    one.shown_dB = middle_snr_dB(calibration.leaves(one.change), chain.noise_slope, rate_Hz);
    one.value = value_of(one, machine, shaker, bare, calibration);
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace

json seal_oscillator(const CasePlan& plan, Draw& draw, const std::filesystem::path& folder) {
  const Oscillators machine = draw_oscillators(draw);
  const Shaker shaker(draw);
  const SlideChain chain = chain_of(plan, rate_Hz, draw);
  const auto bare = shaker.ways_of(machine.built, {}, 0);
  const double way_m = 1.5 * rms(bare.back());
  const double rate = std::sqrt(machine.drawn.stiffness / machine.drawn.mass_kg);
  const SlideScales usual{machine.built.stiffness * way_m, way_m, way_m * rate};
  const auto hidden = hidden_in(plan, machine.built, shaker, bare, usual, chain, draw);
  const double noise_m = plan.kind == "null"
                             ? rms(bare.front()) * (plan.effects.front() == "strong" ? 0.1 : 0.005)
                             : noise_under(hidden, plan);
  write_records(folder, {rate_Hz, "push", "way"},
                shaker.records_of(machine.built, hidden, chain, noise_m, draw));
  write_text(folder / "plant.json", plant_of(machine.drawn).dump(2) + '\n');
  return answer_of(hidden, "mass", plan, noise_m);
}

}  // namespace seal
