#include "sim/terms/rotor_bar.hpp"

#include <cmath>

#include "hal/types/units.hpp"
#include "sim/retuning.hpp"
#include "sim/term_memory.hpp"
#include "sim/terms/induction_motor.hpp"

namespace rvbench::sim {
namespace {

// Remembers ψ by itself: angles of bodies may be wrapped, and a steady state follows it by time.
class RotorBar final : public OneAxisTerm, public TermMemory {
 public:
  RotorBar(const TermSite& at, const InductionMotor& motor)
      : OneAxisTerm("rotor_bar", at.axis),
        motor_(motor),
        depth_(at["depth"]),
        phase_rad_(at["phase"]) {}

  double effort(const PlantState& s) const override {
    return -depth_ * motor_.smooth_torque_Nm(s) * std::cos(2 * s.z[place_] + phase_rad_);
  }
  double supplied_power_W(const PlantState& s) const override { return -effort(s) * speed(s); }
  double fastest_rad_s(const Eigen::VectorXd& inertia) const override {
    return motor_.fastest_rad_s(inertia);
  }
  double rhythm_Hz(const PlantState& s) const override {
    return 2 * std::abs(motor_.slip_rad_s(s)) / units::two_pi;
  }

  Eigen::Index size() const override { return 1; }
  void place(Eigen::Index first) override { place_ = first; }
  bool is_clock() const override { return true; }
  void add_rates(const PlantState& s, Eigen::Ref<Eigen::VectorXd> rates) const override {
    rates[place_] += motor_.slip_rad_s(s);
  }

 private:
  const InductionMotor& motor_;
  double depth_, phase_rad_;
  Eigen::Index place_ = 0;  ///< of ψ
};

}  // namespace

TermType rotor_bar() {
  return {
      .card = {.name = "rotor_bar",
               .equation = "F = −ρ·T_motor·cos(2ψ + φ), dψ/dt = 2π·f − p·v",
               .sign = "ρ >= 0 adds to the motor's torque where the cosine is 1",
               .leaves_out = "the loss of mean torque, 4·s·f and above, what speed ripple at "
                             "2·s·f gives back",
               .source = "Thomson & Fenger, IEEE Ind. Appl. Mag. 7(4), 26-31 (2001)",
               .touches = {{Ledger::electrical,
                            "torque at 2·s·f, twice the slip frequency, growing with load"}},
               .must_not_touch = {{Ledger::electrical, "2·s·f without load"},
                                  {Ledger::shaft, "lines at k/121 of input speed"},
                                  {Ledger::quasi_static, "means"}},
               .mimics = {"speed_modulation", "external_force"},
               .experiment = "change the load at one supply frequency: its frequency follows "
                             "the slip; a hunting drive and an outer force keep theirs"},
      .parameters = {{.name = "depth", .unit = UnitKind::ratio, .min = 0, .max = 1, .start = 0.02},
                     phase_card("phase")},
      .gate = in_a_motor(),
      .make = [](const TermSite& at) -> std::unique_ptr<PhysicsTerm> {
        return std::make_unique<RotorBar>(at, motor_of(at));
      }};
}

}  // namespace rvbench::sim
