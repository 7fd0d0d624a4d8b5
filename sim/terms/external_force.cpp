#include "sim/terms/external_force.hpp"

#include <cmath>

#include "hal/types/units.hpp"
#include "sim/retuning.hpp"
#include "sim/terms/one_axis_term.hpp"

namespace rvbench::sim {
namespace {

class ExternalForce final : public OneAxisTerm {
 public:
  explicit ExternalForce(const TermSite& at)
      : OneAxisTerm("external_force", at.axis),
        amplitude_(at["amplitude"]),
        phase_rad_(at["phase"]),
        frequency_rad_s_(units::two_pi * at["frequency"]) {}

  double effort(const PlantState& s) const override {
    return -amplitude_ * std::cos(frequency_rad_s_ * s.t_s + phase_rad_);
  }
  double supplied_power_W(const PlantState& s) const override { return -effort(s) * speed(s); }
  double fastest_rad_s(const Eigen::VectorXd&) const override { return frequency_rad_s_; }
  double rhythm_Hz(const PlantState&) const override { return frequency_rad_s_ / units::two_pi; }

 private:
  double amplitude_, phase_rad_, frequency_rad_s_;
};

}  // namespace

TermType external_force() {
  return {
      .card = {.name = "external_force",
               .equation = "F = −A·cos(2πft + φ)",
               .sign = "A > 0 pushes forward where the cosine is 1",
               .leaves_out = "harmonics, drift of the frequency",
               .source = "Rao, Mechanical Vibrations, ch. 3",
               .touches = {{Ledger::fixed_frequency, "one line at f, at all speeds and loads"}},
               .must_not_touch = {{Ledger::shaft, "lines that follow the speed"},
                                  {Ledger::quasi_static, "means"}},
               .mimics = {"mains_hum", "inverter_ripple", "housing_mode"},
               .experiment = "change the speed: it stays; stand still: it stays"},
      .parameters =
          {{.name = "amplitude",
            .unit = UnitKind::force,
            .min = 0,
            .max = unbounded,
            .start = 0.02},
           phase_card("phase"),
           {.name = "frequency", .unit = UnitKind::frequency, .min = 0, .max = 1e6, .start = 1}},
      .make = [](const TermSite& at) { return std::make_unique<ExternalForce>(at); }};
}

}  // namespace rvbench::sim
