#include "sim/terms/crank_eccentricity.hpp"

#include "sim/retuning.hpp"

namespace rvbench::sim {

TermType crank_eccentricity() {
  return retuning(
      {.name = "crank_eccentricity",
       .equation = "e(φ) = e·cos(φ + φ_0), φ the crank against the carrier, in series with the "
                   "stage's stiffness",
       .sign = "e >= 0 at φ = −φ_0 presses the disc forward",
       .leaves_out = "the second disc's answer, sidebands of the lobe pass",
       .source = "Blanche & Yang, J. Mech. Des. 111(3), 337-344 (1989)",
       .touches = {{Ledger::shaft, "the crank's turn against carrier and housing"}},
       .must_not_touch = {{Ledger::shaft, "sidebands of the planets' mesh"},
                          {Ledger::quasi_static, "means"}},
       .mimics = {"gear_eccentricity"},
       .experiment = "look which carrier is modulated: lobe pass, or mesh"},
      "cycloid_stage", true, {deviation_card("crank_error"), phase_card("crank_phase")});
}

}  // namespace rvbench::sim
