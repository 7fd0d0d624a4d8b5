#include "sim/terms/gear_eccentricity.hpp"

#include "sim/retuning.hpp"

namespace rvbench::sim {

TermType gear_eccentricity() {
  return retuning(
      {.name = "gear_eccentricity",
       .equation = "e_p(ψ) = e·cos(ψ + φ), in series with the mesh's stiffness",
       .sign = "e >= 0 at the planet's angle −φ presses the teeth",
       .leaves_out = "the change of the pressure angle",
       .source = "Smith, Gear Noise and Vibration, 2nd ed., ch. 9",
       .touches = {{Ledger::shaft,
                    "the planet's turn against the carrier; sidebands of that spacing "
                    "around the mesh"}},
       .must_not_touch = {{Ledger::shaft, "the lobe pass"}, {Ledger::quasi_static, "means"}},
       .mimics = {"crank_eccentricity"},
       .experiment = "look which carrier is modulated: mesh, or lobe pass"},
      "planet_mesh", true,
      {deviation_card("planet_eccentricity"), phase_card("planet_eccentricity_phase")});
}

}  // namespace rvbench::sim
