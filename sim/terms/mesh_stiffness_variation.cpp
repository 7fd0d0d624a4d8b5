#include "sim/terms/mesh_stiffness_variation.hpp"

#include "sim/retuning.hpp"

namespace rvbench::sim {

TermType mesh_stiffness_variation() {
  return retuning(
      {.name = "mesh_stiffness_variation",
       .equation = "k(α) = k·(1 + Σ ε/h·cos h(z_s·α + φ))",
       .sign = "ε >= 0 is the relative amplitude of the first harmonic",
       .leaves_out = "what friction on the flanks adds, loss of contact",
       .source = "Kahraman & Singh, J. Sound Vib. 142(1), 49-75 (1990)",
       .touches = {{Ledger::shaft, "mesh order and its multiples, growing with the load from 0"}},
       .must_not_touch = {{Ledger::shaft, "mesh lines at no load"},
                          {Ledger::quasi_static, "means"}},
       .mimics = {"transmission_error"},
       .experiment = "load steps at one speed: its lines go through zero with the load"},
      "planet_mesh", false,
      {{.name = "stiffness_ripple", .unit = UnitKind::ratio, .min = 0, .max = 1, .start = 0.1},
       phase_card("stiffness_ripple_phase")});
}

}  // namespace rvbench::sim
