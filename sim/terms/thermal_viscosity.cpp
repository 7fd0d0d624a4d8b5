#include "sim/terms/thermal_viscosity.hpp"

#include <algorithm>
#include <cmath>

#include "sim/effect_edits.hpp"
#include "sim/term_memory.hpp"

namespace rvbench::sim {
namespace {

class ThermalViscosity final : public OneAxisTerm, public TermMemory {
 public:
  explicit ThermalViscosity(const TermSite& at)
      : OneAxisTerm("thermal_viscosity", at.axis),
        damping_(at["damping"]),
        decay_per_K_(at["decay"]),
        resistance_K_W_(at["thermal_resistance"]),
        time_constant_s_(at["time_constant"]) {}

  double effort(const PlantState& s) const override {
    return damping_ * std::exp(-decay_per_K_ * s.z[place_]) * speed(s);
  }
  double dissipated_power_W(const PlantState& s) const override { return effort(s) * speed(s); }
  double fastest_rad_s(const Eigen::VectorXd& inertia) const override {
    return std::max(damping_ * mobility(inertia), 1 / time_constant_s_);
  }

  Eigen::Index size() const override { return 1; }
  void place(Eigen::Index first) override { place_ = first; }
  void add_rates(const PlantState& s, Eigen::Ref<Eigen::VectorXd> rates) const override {
    rates[place_] += (resistance_K_W_ * dissipated_power_W(s) - s.z[place_]) / time_constant_s_;
  }

 private:
  double damping_, decay_per_K_, resistance_K_W_, time_constant_s_;
  Eigen::Index place_ = 0;
};

}  // namespace

TermType thermal_viscosity() {
  return {
      .card = {.name = "thermal_viscosity",
               .equation = "F = b·exp(−β·θ)·v, dθ/dt = (R·F·v − θ)/τ",
               .sign = "b >= 0 opposes motion, less the longer it runs",
               .leaves_out = "heat from other losses, the temperature of the room",
               .source = "Bittencourt & Axelsson, IEEE/ASME Trans. Mechatronics 19(5), "
                         "1669-1678 (2014)",
               .touches = {{Ledger::quasi_static, "torque drift over minutes, faster at speed"}},
               .must_not_touch = {{Ledger::shaft, "lines of the shaft"},
                                  {Ledger::quasi_static, "torque at standstill"}},
               .mimics = {"viscous_friction", "shear_thinning", "torque_offset"},
               .experiment = "cold and hot repeat of one condition, in random order"},
      .parameters =
          {{.name = "damping", .unit = UnitKind::damping, .min = 0, .max = unbounded, .start = 0.1},
           {.name = "decay",
            .unit = UnitKind::per_temperature,
            .min = 0,
            .max = 0.1,
            .start = 0.03,
            .fallback = 0.03,
            .fitted = false},
           {.name = "thermal_resistance",
            .unit = UnitKind::thermal_resistance,
            .min = 0,
            .max = unbounded,
            .start = 0.5},
           {.name = "time_constant", .unit = UnitKind::time, .min = 1, .max = 1e5, .start = 1000}},
      .make = [](const TermSite& at) { return std::make_unique<ThermalViscosity>(at); },
      .edit =
          [](PlantSpec plant, const EffectSite& site, const Parameters& parameters) {
            return replace_or_append(std::move(plant), "thermal_viscosity", site, parameters);
          }};
}

}  // namespace rvbench::sim
