#include "sim/terms/transmission_error.hpp"

#include "sim/retuning.hpp"

namespace rvbench::sim {

TermType transmission_error() {
  return retuning(
      {.name = "transmission_error",
       .equation = "e_s(α) = Σ e/h·cos h(z_s·α + φ), in series with the mesh's stiffness",
       .sign = "e >= 0 at the angle −φ/z_s presses the teeth",
       .leaves_out = "how load bends it away; differences between the planets",
       .source = "Smith, Gear Noise and Vibration, 2nd ed., ch. 2",
       .touches = {{Ledger::shaft,
                    "mesh order and its multiples, in torque and all accelerations, "
                    "at no load too"}},
       .must_not_touch = {{Ledger::quasi_static, "means"}, {Ledger::shaft, "order 1"}},
       .mimics = {"mesh_stiffness_variation", "pin_ripple"},
       .experiment = "load steps at one speed: what is left at no load is transmission error"},
      "planet_mesh", false, {deviation_card("profile_error"), phase_card("profile_phase")});
}

}  // namespace rvbench::sim
