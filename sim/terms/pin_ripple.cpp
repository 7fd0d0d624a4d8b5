#include "sim/terms/pin_ripple.hpp"

#include "sim/retuning.hpp"

namespace rvbench::sim {

TermType pin_ripple() {
  return retuning(
      {.name = "pin_ripple",
       .equation = "e(φ) = e·cos(z_p·φ + φ_0), φ the crank against the carrier, in series with the "
                   "stage's stiffness",
       .sign = "e >= 0 at φ = −φ_0/z_p presses the discs against the pins",
       .leaves_out = "the share of each pin, load sharing",
       .source = "Blanche & Yang, J. Mech. Des. 111(3), 337-344 (1989)",
       .touches = {{Ledger::shaft, "the lobe pass and its multiples"}},
       .must_not_touch = {{Ledger::shaft, "the planets' mesh"}, {Ledger::quasi_static, "means"}},
       .mimics = {"inverter_ripple", "transmission_error"},
       .experiment = "change the load: slip moves the supply's lines, the lobe pass stays"},
      "cycloid_stage", false, {deviation_card("pin_error"), phase_card("pin_phase")});
}

}  // namespace rvbench::sim
