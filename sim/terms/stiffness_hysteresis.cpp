#include "sim/terms/stiffness_hysteresis.hpp"

#include <cmath>

#include "sim/term_memory.hpp"

namespace rvbench::sim {
namespace {

class StiffnessHysteresis final : public OneAxisTerm, public TermMemory {
 public:
  explicit StiffnessHysteresis(const TermSite& at)
      : OneAxisTerm("stiffness_hysteresis", at.axis),
        stiffness_(at["stiffness"]),
        yield_(at["yield"]) {}

  double effort(const PlantState& s) const override { return stiffness_ * s.z[place_]; }
  double stored_energy_J(const PlantState& s) const override {
    return 0.5 * stiffness_ * s.z[place_] * s.z[place_];
  }
  double dissipated_power_W(const PlantState& s) const override {
    return stiffness_ * s.z[place_] * slip_speed(s);
  }
  double fastest_rad_s(const Eigen::VectorXd& inertia) const override {
    return std::sqrt(stiffness_ * mobility(inertia));
  }

  Eigen::Index size() const override { return 1; }
  void place(Eigen::Index first) override { place_ = first; }
  void add_rates(const PlantState& s, Eigen::Ref<Eigen::VectorXd> rates) const override {
    rates[place_] += speed(s) - slip_speed(s);
  }

 private:
  double slip_speed(const PlantState& s) const {
    const double z = s.z[place_], v = speed(s);
    return z * v > 0 ? v * std::abs(z) / yield_ : 0;
  }

  double stiffness_, yield_;
  Eigen::Index place_ = 0;
};

}  // namespace

TermType stiffness_hysteresis() {
  return {.card = {.name = "stiffness_hysteresis",
                   .equation = "F = k·z, dz/dt = v·(1 − |z|/y) while loading, v while unloading",
                   .sign = "k >= 0; the force ends at k·y",
                   .leaves_out = "hardening, several elements in parallel",
                   .source = "Ismail, Ikhouane & Rodellar, Arch. Comput. Methods Eng. 16, 161-188 "
                             "(2009)",
                   .touches = {{Ledger::quasi_static, "area of the torque-angle loop, angle lag"},
                               {Ledger::fixed_frequency, "damping of the torsional mode"}},
                   .must_not_touch = {{Ledger::quasi_static, "dependence of the loop on its rate"}},
                   .mimics = {"backlash", "coulomb_friction", "load_friction"},
                   .experiment = "locked-input torque loop at three amplitudes and two rates"},
          .parameters = {{.name = "stiffness",
                          .unit = UnitKind::stiffness,
                          .min = 0,
                          .max = unbounded,
                          .start = 0.1},
                         {.name = "yield",
                          .unit = UnitKind::coordinate,
                          .min = smallest,
                          .max = unbounded,
                          .start = 0.3}},
          .make = [](const TermSite& at) { return std::make_unique<StiffnessHysteresis>(at); }};
}

}  // namespace rvbench::sim
