#include "sim/terms/tooth_damage.hpp"

#include "sim/retuning.hpp"

namespace rvbench::sim {

TermType tooth_damage() {
  return retuning(
      {.name = "tooth_damage",
       .equation = "e_p(ψ) = −d over a third of a tooth's pitch at ψ = β, 0 elsewhere",
       .sign = "d >= 0 is the height that the flank has lost",
       .leaves_out = "loss of contact, what the next tooth takes over",
       .source = "Parey & Tandon, Shock Vib. Dig. 35(6), 465-478 (2003)",
       .touches = {{Ledger::shaft, "many harmonics of the planet's turn against the carrier"},
                   {Ledger::broadband, "knocks, once per turn of the planet"}},
       .must_not_touch = {{Ledger::quasi_static, "means"}},
       .mimics = {"gear_eccentricity", "bearing_defect"},
       .experiment = "average over turns of the planet: one sector stands out"},
      "planet_mesh", true, {deviation_card("lost_flank"), place_card("lost_flank_place")});
}

}  // namespace rvbench::sim
