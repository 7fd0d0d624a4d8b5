#include "sim/terms/speed_modulation.hpp"

#include <algorithm>
#include <cmath>

#include "hal/types/units.hpp"
#include "sim/retuning.hpp"
#include "sim/terms/induction_motor.hpp"

namespace rvbench::sim {
namespace {

class SpeedModulation final : public OneAxisTerm {
 public:
  SpeedModulation(const TermSite& at, const InductionMotor& motor)
      : OneAxisTerm("speed_modulation", at.axis),
        motor_(motor),
        depth_(at["depth"]),
        phase_rad_(at["phase"]),
        frequency_rad_s_(units::two_pi * at["frequency"]) {}

  double effort(const PlantState& s) const override {
    const double swing = depth_ * std::cos(frequency_rad_s_ * s.t_s + phase_rad_);
    return motor_.smooth_torque_Nm(s) -
           motor_.smooth_torque_Nm(motor_.supply_Hz(s) * (1 + swing), s);
  }
  double supplied_power_W(const PlantState& s) const override { return -effort(s) * speed(s); }
  double fastest_rad_s(const Eigen::VectorXd& inertia) const override {
    return std::max(motor_.fastest_rad_s(inertia), frequency_rad_s_);
  }
  double rhythm_Hz(const PlantState&) const override { return frequency_rad_s_ / units::two_pi; }

 private:
  const InductionMotor& motor_;
  double depth_, phase_rad_, frequency_rad_s_;
};

}  // namespace

TermType speed_modulation() {
  return {
      .card = {.name = "speed_modulation",
               .equation = "F = −[T_motor(f·(1 + m·cos(2π·f_m·t + φ))) − T_motor(f)]",
               .sign = "m >= 0 drives faster where the cosine is 1",
               .leaves_out = "electrical transients, the voltage that swings too, phase of the "
                             "inverter's ripple; compared by orders, it is tried at the mains' "
                             "frequencies only: 50, 60, 100 and 120 Hz",
               .source = "Lipo & Krause, IEEE Trans. Power App. Syst. 88(1), 55-66 (1969)",
               .touches = {{Ledger::fixed_frequency,
                            "torque and speed at f_m under all loads, growing with f"}},
               .must_not_touch = {{Ledger::shaft, "lines after order tracking"},
                                  {Ledger::quasi_static,
                                   "means, to the first order of m: what T is curved by adds "
                                   "T''·δ²/4 to the torque, δ the swing of the slip"}},
               .mimics = {"external_force", "rotor_bar", "torsional_mode"},
               .experiment = "change the drive's gains or its slip compensation: it moves or goes; "
                             "change the load: a broken bar's line moves, this one stays"},
      .parameters =
          {{.name = "depth", .unit = UnitKind::ratio, .min = 0, .max = 1, .start = 0.01},
           phase_card("phase"),
           {.name = "frequency", .unit = UnitKind::frequency, .min = 0, .max = 1e3, .start = 1}},
      .gate = in_a_motor(),
      .make = [](const TermSite& at) -> std::unique_ptr<PhysicsTerm> {
        return std::make_unique<SpeedModulation>(at, motor_of(at));
      }};
}

}  // namespace rvbench::sim
