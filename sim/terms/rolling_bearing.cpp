#include "sim/terms/rolling_bearing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "hal/types/units.hpp"
#include "sim/random_source.hpp"
#include "sim/term_memory.hpp"

namespace rvbench::sim {
namespace {

using std::numbers::pi;

constexpr double renewal_s = 20e-6;  // chance holds as long: flat within 4 % up to 5 kHz
constexpr double steps_per_blow = 8;
constexpr double fastest_swing_steps = 24;  // in which a plant resolves a period
constexpr int most_harmonics = 6;           // of a spall's passes that are told

// Steele, Lea & Flood, OOPSLA (2014): one well-mixed number for each count.
std::uint64_t mixed(std::uint64_t count) {
  std::uint64_t x = (count + 1) * 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

enum class Chance : std::uint64_t { of_roughness, of_spacing };

// Normal numbers, the same each time for the same seed, kind and count.
double normal(double seed, Chance of, double count) {
  const auto stream = mixed(2 * static_cast<std::uint64_t>(seed) + static_cast<std::uint64_t>(of));
  const auto pair = stream + 2 * static_cast<std::uint64_t>(static_cast<std::int64_t>(count));
  const auto uniform = [](std::uint64_t at) { return (double(mixed(at) >> 11U) + 0.5) * 0x1p-53; };
  return std::sqrt(-2 * std::log(uniform(pair))) * std::cos(units::two_pi * uniform(pair + 1));
}

double sinc(double x) { return x == 0 ? 1 : std::sin(pi * x) / (pi * x); }

class RollingBearing final : public OneAxisTerm, public TermMemory, public RandomSource {
 public:
  explicit RollingBearing(const TermSite& at)
      : OneAxisTerm("rolling_bearing", at.axis),
        shaft_speed_(at.input),
        roughness_(at["roughness_force"]),
        corner_rad_s_(units::two_pi * at["roughness_corner"]),
        once_(at["load_zone_once"]),
        twice_(at["load_zone_twice"]),
        spall_(spall_of(at)),
        impulse_(at["impact_impulse"]),
        blow_s_(at["impact_time"]),
        scatter_(at["impact_scatter"]),
        seed_(at["seed"]) {
    if (!(at["pitch_diameter"] > at["ball_diameter"])) {
      throw std::invalid_argument("rolling_bearing: the balls must be smaller than their circle");
    }
  }

  double effort(const PlantState& s) const override {
    const double angle_rad = s.z[place_];
    const double struck = strikes() && spall_.loads_per_turn > 0
                              ? loaded(spall_.loads_per_turn * angle_rad) * blows(s)
                              : blows(s);
    return -(loaded(angle_rad) * s.z[place_ + 1] + struck);
  }
  double supplied_power_W(const PlantState& s) const override { return -effort(s) * speed(s); }
  double fastest_rad_s(const Eigen::VectorXd&) const override {
    const double step_s = strikes() ? std::min(renewal_s, blow_s_ / steps_per_blow) : renewal_s;
    return std::max(units::two_pi / (fastest_swing_steps * step_s), corner_rad_s_);
  }

  Eigen::Index size() const override { return 2; }
  void place(Eigen::Index first) override { place_ = first; }
  void add_rates(const PlantState& s, Eigen::Ref<Eigen::VectorXd> rates) const override {
    const double chance = roughness_ * std::sqrt(2 / (corner_rad_s_ * renewal_s)) *
                          normal(seed_, Chance::of_roughness, std::floor(s.t_s / renewal_s));
    rates[place_] += units::two_pi * s.u[shaft_speed_];
    rates[place_ + 1] += corner_rad_s_ * (chance - s.z[place_ + 1]);
  }

  void add_random(const Eigen::VectorXd& u, Eigen::Index bodies,
                  std::vector<RandomForce>& forces) const override {
    const double shaft_Hz = std::abs(u[shaft_speed_]);
    Eigen::VectorXd push = Eigen::VectorXd::Zero(bodies);
    give(-1, push);
    const auto rough = [level = 4 * roughness_ * roughness_ / corner_rad_s_,
                        corner_Hz = corner_rad_s_ / units::two_pi](double f_Hz) {
      const double part = f_Hz / corner_Hz, held = sinc(f_Hz * renewal_s);
      return level * held * held / (1 + part * part);
    };
    forces.push_back({push, rough, {{shaft_Hz, once_}, {2 * shaft_Hz, twice_}}});
    if (!strikes()) return;
    const double pass_Hz = spall_.passes_per_turn * shaft_Hz;
    const double load_Hz = spall_.loads_per_turn * shaft_Hz;
    const auto blow = [impulse = impulse_, length_s = blow_s_, pass_Hz](double f_Hz) {
      const double part = 2 * f_Hz * length_s;
      const double shape =
          std::abs(part - 1) < 1e-6 ? pi / 4 : std::cos(pi * part / 2) / (1 - part * part);
      return 2 * pass_Hz * std::pow(impulse * shape, 2);
    };
    forces.push_back({push, blow, {}});
    std::vector<RandomForce::Swell>& swells = forces.back().swells;
    if (load_Hz > 0) swells = {{load_Hz, once_}, {2 * load_Hz, twice_}};
    for (int k = 1; k <= most_harmonics; ++k) {
      const double depth = 2 * std::exp(-0.5 * std::pow(units::two_pi * k * scatter_, 2));
      add_with_sidebands(k * pass_Hz, depth, load_Hz, swells);
    }
  }

 private:
  // Per turn of the shaft: passes of the spall, and how often it goes through the load zone; the
  // outer race stays where it is loaded.
  struct Spall {
    double passes_per_turn = 0, loads_per_turn = 0;
  };

  static Spall spall_of(const TermSite& at) {
    const double part = at["spalled_part"];
    if (part != std::floor(part)) {
      throw std::invalid_argument("rolling_bearing: spalled_part is 0, 1, 2 or 3");
    }
    const double ratio = at["ball_diameter"] / at["pitch_diameter"] * std::cos(at["contact_angle"]);
    switch (static_cast<BearingPart>(static_cast<int>(part))) {
      case BearingPart::outer_race: return {0.5 * at["balls"] * (1 - ratio), 0};
      case BearingPart::inner_race: return {0.5 * at["balls"] * (1 + ratio), 1};
      case BearingPart::rolling_element:
        return {at["pitch_diameter"] / at["ball_diameter"] * (1 - ratio * ratio),
                0.5 * (1 - ratio)};
      case BearingPart::none: break;
    }
    return {};
  }

  double loaded(double angle_rad) const {
    const double power = 1 + once_ * std::cos(angle_rad) + twice_ * std::cos(2 * angle_rad);
    return std::sqrt(std::max(0.0, power));
  }

  void add_with_sidebands(double frequency_Hz, double depth, double load_Hz,
                          std::vector<RandomForce::Swell>& swells) const {
    swells.push_back({frequency_Hz, depth});
    if (load_Hz == 0) return;
    for (const auto& [turns, part] : {std::pair(1, once_), std::pair(2, twice_)}) {
      for (const int side : {-1, 1}) {
        swells.push_back({std::abs(frequency_Hz + side * turns * load_Hz), depth * part / 2});
      }
    }
  }

  bool strikes() const { return spall_.passes_per_turn > 0 && impulse_ != 0; }

  // Of the passes that may be felt now.
  double blows(const PlantState& s) const {
    const double pass_Hz = spall_.passes_per_turn * std::abs(s.u[shaft_speed_]);
    if (!strikes() || pass_Hz == 0) return 0;
    const double passed = spall_.passes_per_turn * std::abs(s.z[place_]) / units::two_pi;
    const double reach = std::ceil(4 * scatter_ + pass_Hz * blow_s_);
    const double peak = 0.5 * pi * impulse_ / blow_s_;
    double force = 0;
    for (double i = std::floor(passed) - reach; i <= passed + reach; ++i) {
      const double since_s =
          (passed - i - scatter_ * normal(seed_, Chance::of_spacing, i)) / pass_Hz;
      if (since_s >= 0 && since_s < blow_s_) force += peak * std::sin(pi * since_s / blow_s_);
    }
    return force;
  }

  int shaft_speed_;
  double roughness_, corner_rad_s_, once_, twice_;
  Spall spall_;
  double impulse_, blow_s_, scatter_, seed_;
  Eigen::Index place_ = 0;
};

ParameterCard geometry(std::string name, UnitKind unit, double min, double start) {
  return {.name = std::move(name), .unit = unit, .min = min, .max = unbounded, .start = start};
}

ParameterCard swell(std::string name) {
  return {.name = std::move(name), .min = -1, .max = 1, .start = 0.1, .fallback = 0};
}

}  // namespace

TermType rolling_bearing() {
  return {
      .card =
          {.name = "rolling_bearing",
           .effect = false,
           .equation =
               "F = −√(1 + a₁·cos φ + a₂·cos 2φ)·w − √(1 + a₁·cos νφ + a₂·cos 2νφ)·Σ P(t − t_i)",
           .sign = "random: either way",
           .leaves_out = "slip, the double blow of entry and exit, the cage, load",
           .source = "Antoni & Randall, J. Vib. Acoust. 125(3), 282-289 (2003)"},
      .parameters = {geometry("balls", UnitKind::ratio, 3, 9),
                     geometry("ball_diameter", UnitKind::length, smallest, 8e-3),
                     geometry("pitch_diameter", UnitKind::length, smallest, 40e-3),
                     {.name = "contact_angle",
                      .unit = UnitKind::angle,
                      .min = 0,
                      .max = 1.5,
                      .start = 0,
                      .fallback = 0},
                     {.name = "roughness_force",
                      .unit = UnitKind::force,
                      .min = 0,
                      .max = unbounded,
                      .start = 1},
                     {.name = "roughness_corner",
                      .unit = UnitKind::frequency,
                      .min = 1,
                      .max = 2e4,
                      .start = 1000},
                     swell("load_zone_once"),
                     swell("load_zone_twice"),
                     {.name = "spalled_part", .min = 0, .max = 3, .start = 2, .fallback = 0},
                     {.name = "impact_impulse",
                      .unit = UnitKind::impulse,
                      .min = 0,
                      .max = unbounded,
                      .start = 2e-3,
                      .fallback = 0},
                     {.name = "impact_time",
                      .unit = UnitKind::time,
                      .min = 1e-5,
                      .max = 1e-3,
                      .start = 1e-4,
                      .fallback = 1e-4},
                     {.name = "impact_scatter", .min = 0, .max = 0.3, .start = 0.05, .fallback = 0},
                     {.name = "seed", .min = 0, .max = 1e9, .start = 1, .fallback = 0}},
      .gate = {.between_two = true,
               .reference = ReferenceKind::input,
               .reference_key = "shaft_speed"},
      .make = [](const TermSite& at) { return std::make_unique<RollingBearing>(at); }};
}

}  // namespace rvbench::sim
