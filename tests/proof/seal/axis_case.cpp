#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "tests/proof/seal/noise.hpp"
#include "tests/proof/seal/sealed_case.hpp"
#include "tests/proof/seal/slide_calibration.hpp"
#include "tests/proof/seal/slide_effects/slide_effects.hpp"
#include "tests/proof/seal/slide_records.hpp"
#include "tests/proof/seal/write_text.hpp"

namespace seal {
namespace {

using nlohmann::json;

constexpr double rate_Hz = 500, band_Hz = 40;
constexpr double length_s = 6;
constexpr int repeats = 3;
constexpr int steps_per_sample = 4;
constexpr double stroke_m = 0.2;
constexpr double weight_known_pct = 5;

const std::map<std::string, HiddenInSlide (*)(const SlideScales&, Draw&)> all_effects{
    {"asymmetric_friction", asymmetric_friction},
    {"coulomb_friction", coulomb_friction},
    {"cubic_stiffness", cubic_stiffness},
    {"nonlinear_damping", nonlinear_damping},
    {"screw_ripple", screw_ripple},
    {"shear_thinning", shear_thinning},
    {"stiffness_hysteresis", stiffness_hysteresis},
    {"stribeck_friction", stribeck_friction},
    {"viscous_friction", viscous_friction}};

/// A slide that a servo moves: what it weighs and what holds it back.
struct Axis {
  double mass_kg = 0, drag = 0, offset_N = 0;
};

/// To and fro by moves of the fifth power with rests between, slower and shorter in turn.
struct Motion {
  double peak_m_s = 0, stroke_m = 0;
  bool returns = true;  ///< false: each move begins where the last one ended

  double move_s() const { return 15.0 / 8 * stroke_m / peak_m_s; }
  double rest_s() const { return 0.15; }

  // Way, speed and acceleration.
  std::array<double, 3> at(double time_s) const {
    const double each_s = move_s() + rest_s();
    const double in = std::fmod(time_s, 2 * each_s);
    const bool is_back = in >= each_s;
    const double t = std::clamp((in - (is_back ? each_s : 0)) / move_s(), 0.0, 1.0);
    const double way = t * t * t * (10 - 15 * t + 6 * t * t);
    const double speed = 30 * t * t * (1 - 2 * t + t * t) / move_s();
    const double acceleration = (60 * t - 180 * t * t + 120 * t * t * t) / move_s() / move_s();
    const double side = is_back && returns ? -1 : 1;
    const double done = returns ? (is_back ? 1 - way : way) - 0.5
                                : 2 * std::floor(time_s / 2 / each_s) + (is_back ? 1 + way : way);
    return {stroke_m * done, side * stroke_m * speed, side * stroke_m * acceleration};
  }
};

bool hides(const CasePlan& plan, const char* effect) {
  return std::ranges::find(plan.effects, effect) != plan.effects.end();
}

bool is_one_way(const CasePlan& plan) { return plan.variant == "one way"; }

std::vector<Motion> motions_of(const CasePlan& plan) {
  if (is_one_way(plan)) {
    return {{0.05, 0.06, false}, {0.2, stroke_m, false}, {0.5, stroke_m, false}};
  }
  return {{0.05, 0.06}, {0.2, stroke_m}, {0.5, stroke_m}};
}

// @param knows_weight  that hangs on it: else an offset does what friction of one direction does
json plant_of(const Axis& axis, bool knows_drag, bool knows_weight) {
  json terms = json::array();
  if (knows_drag) {
    terms.push_back({{"type", "viscous_friction"},
                     {"body_a", "slide"},
                     {"parameters", {{"damping", quantity(axis.drag, "N·s/m", 20)}}}});
  }
  terms.push_back({{"type", "torque_offset"},
                   {"body_a", "slide"},
                   {"parameters",
                    {{"level", quantity(axis.offset_N, "N",
                                        knows_weight ? json(weight_known_pct) : json("free"))}}}});
  return {{"plant", "axis"},
          {"about", "a slide that a servo moves: the force that its motion needs"},
          {"bodies",
           {{{"name", "slide"},
             {"motion", "translation"},
             {"mass", quantity(axis.mass_kg, "kg", 10)}}}},
          {"terms", terms},
          {"inputs",
           {{{"channel", "way"},
             {"unit", "m"},
             {"is", "position"},
             {"body", "slide"},
             {"band_Hz", band_Hz}}}},
          {"outputs",
           {{{"channel", "force"},
             {"unit", "N"},
             {"is", "drive"},
             {"body", "slide"},
             {"gain", quantity(1, "1", 3)},
             {"delay", quantity(0, "s", "free")}}}}};
}

// What one effect takes, over each motion.
std::vector<Eigen::VectorXd> forces_of(const std::vector<Motion>& motions,
                                       const HiddenInSlide& effect, double size,
                                       double delay_s = 0) {
  std::vector<Eigen::VectorXd> forces_N;
  constexpr auto count = static_cast<Eigen::Index>(length_s * rate_Hz);
  constexpr double step_s = 1 / rate_Hz / steps_per_sample;
  for (const Motion& motion : motions) {
    const auto acting = effect.make(size);
    const auto force_N = [&](double time_s) {
      const auto [way, speed, acceleration] = motion.at(time_s);
      return acting->force_N(way, speed, step_s);
    };
    const auto period = static_cast<int>(2 * (motion.move_s() + motion.rest_s()) / step_s);
    for (int i = -period; i < 0; ++i) force_N(period * step_s + i * step_s);
    Eigen::VectorXd shown(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      double sum_N = 0;
      for (int s = 0; s < steps_per_sample; ++s) {
        sum_N +=
            force_N((static_cast<double>(k) + double(s) / steps_per_sample) / rate_Hz - delay_s);
      }
      shown[k] = sum_N / steps_per_sample;
    }
    forces_N.push_back(std::move(shown));
  }
  return forces_N;
}

Eigen::VectorXd force_of(const Axis& axis, const Motion& motion, double delay_s) {
  return Eigen::VectorXd::NullaryExpr(
      static_cast<Eigen::Index>(length_s * rate_Hz), [&](Eigen::Index k) {
        const auto [way, speed, acceleration] = motion.at(
            static_cast<double>(k) / rate_Hz - delay_s + 2 * (motion.move_s() + motion.rest_s()));
        return axis.mass_kg * acceleration + axis.drag * speed + axis.offset_N;
      });
}

double rms_of(const std::vector<Eigen::VectorXd>& all) {
  double square = 0;
  for (const Eigen::VectorXd& x : all) square += rms(x) * rms(x) / double(all.size());
  return std::sqrt(square);
}

// As a drawing has it, and as it was built.
struct Axes {
  Axis drawn, built;
  bool has_drag = true;
};

Axes draw_axes(const CasePlan& plan, Draw& draw) {
  const Axis drawn{60 * draw.within_factor(2), 120 * draw.within_factor(2), draw.uniform(-5, 5)};
  const bool hides_drag = hides(plan, "viscous_friction") || hides(plan, "shear_thinning");
  // Some have none though none is hidden, lest a plant file without it gives away that one is.
  const bool has_drag = !hides_drag && !draw.one_in(3);
  const Axis built{drawn.mass_kg * (1 + 0.1 * draw.uniform(-1, 1)),
                   has_drag ? drawn.drag * (1 + 0.2 * draw.uniform(-1, 1)) : 0,
                   drawn.offset_N * (1 + weight_known_pct / 100 * draw.uniform(-1, 1))};
  return {drawn, built, has_drag};
}

// Mass, drag and offset where the plant file leaves them open, and the delay. A gain is in them.
SlideCalibration calibration_of(const Axes& axes, bool knows_weight,
                                const std::vector<Motion>& motions, double delay_s) {
  std::vector<std::vector<Eigen::VectorXd>> moved;
  const auto add = [&](const Axis& by, double late_s) {
    auto& change = moved.emplace_back();
    for (const Motion& motion : motions) change.push_back(force_of(by, motion, late_s));
  };
  add({1, 0, 0}, delay_s);
  if (axes.has_drag) add({0, 1, 0}, delay_s);
  if (!knows_weight) add({0, 0, 1}, delay_s);
  add(axes.built, delay_s + 1 / rate_Hz);
  return SlideCalibration(moved);
}

// The effects of a plan, each as far below the usual force as it is to be.
std::vector<HiddenSlide> hidden_in(const CasePlan& plan, const std::vector<Motion>& motions,
                                   const SlideScales& usual, const SlideChain& chain,
                                   const SlideCalibration& calibration, Draw& draw) {
  std::vector<HiddenSlide> all;
  if (plan.kind == "null") return all;
  for (const std::string& name : plan.effects) {
    HiddenInSlide effect = all_effects.at(name)(usual, draw);
    if (is_one_way(plan)) effect.also = {"coulomb_friction", "asymmetric_friction"};
    const double as_large = rms_of(forces_of(motions, effect, effect.size));
    const double size =
        effect.size * usual.force_N * std::pow(10, -plan.concealment_dB / 20) / as_large;
    auto forces_N = forces_of(motions, effect, size, chain.delay_s);
    const double shown_dB =
        is_one_way(plan) ? 20 * std::log10(rms_of(forces_N))
                         : middle_snr_dB(calibration.leaves(forces_N), chain.noise_slope, rate_Hz);
    const double value =
        effect.law
            ? calibration.times(forces_of(motions, as_law(effect), 1, chain.delay_s), forces_N)
            : size;
    all.push_back({std::move(effect), size, std::move(forces_N), shown_dB, value});
  }
  return all;
}

double noise_of(const CasePlan& plan, const std::vector<HiddenSlide>& hidden, double usual_N) {
  if (plan.kind == "null") return usual_N * (plan.effects.front() == "strong" ? 0.1 : 0.01);
  return std::max(noise_under(hidden, plan), 1e-4 * usual_N);
}

std::vector<SlideRecord> records_of(const Axis& built, const std::vector<Motion>& motions,
                                    const std::vector<HiddenSlide>& hidden, const SlideChain& chain,
                                    double noise_N, Draw& draw) {
  std::vector<SlideRecord> records;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const Motion& motion = motions[i];
    const double period_s = 2 * (motion.move_s() + motion.rest_s());
    Eigen::VectorXd force_N = force_of(built, motion, chain.delay_s);
    for (const HiddenSlide& one : hidden) force_N += one.change[i];
    for (int repeat = 1; repeat <= repeats; ++repeat) {
      SlideRecord record{fmt::format("{:g} m/s", motion.peak_m_s),
                         fmt::format("to and fro at {:g} m/s", motion.peak_m_s),
                         {},
                         {}};
      record.input = Eigen::VectorXd::NullaryExpr(force_N.size(), [&](Eigen::Index k) {
        return motion.at(static_cast<double>(k) / rate_Hz + period_s)[0] + 2e-7 * draw.normal();
      });
      record.output =
          chain.gain * force_N + noise_N * coloured_noise(force_N.size(), chain.noise_slope, draw);
      records.push_back(std::move(record));
    }
  }
  return records;
}

}  // namespace

json seal_axis(const CasePlan& plan, Draw& draw, const std::filesystem::path& folder) {
  const Axes axes = draw_axes(plan, draw);
  const std::vector<Motion> motions = motions_of(plan);
  std::vector<Eigen::VectorXd> bare;
  for (const Motion& motion : motions) bare.push_back(force_of(axes.built, motion, 0));
  const SlideScales usual{rms_of(bare), stroke_m / 2, 0.5};
  const SlideChain chain = chain_of(plan, rate_Hz, draw);
  const bool knows_weight =
      hides(plan, "asymmetric_friction") || is_one_way(plan) || draw.one_in(2);
  const auto hidden = hidden_in(plan, motions, usual, chain,
                                calibration_of(axes, knows_weight, motions, chain.delay_s), draw);
  const double noise_N = noise_of(plan, hidden, usual.force_N);
  write_records(folder, {rate_Hz, "way", "force"},
                records_of(axes.built, motions, hidden, chain, noise_N, draw));
  write_text(folder / "plant.json",
             plant_of(axes.drawn, axes.has_drag, knows_weight).dump(2) + '\n');
  return answer_of(hidden, "slide", plan, noise_N);
}

}  // namespace seal
