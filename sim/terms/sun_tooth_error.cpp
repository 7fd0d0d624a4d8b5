#include "sim/terms/sun_tooth_error.hpp"

#include "sim/retuning.hpp"

namespace rvbench::sim {

TermType sun_tooth_error() {
  return retuning(
      {.name = "sun_tooth_error",
       .equation = "e_s(ψ) = Σ_h (e/h)·cos(hψ + h²φ), in series with the stiffness of every mesh",
       .sign = "e >= 0 at the sun's angle −φ presses the teeth",
       .leaves_out = "what differs from one planet to the next",
       .source = "Smith, Gear Noise and Vibration, 2nd ed., ch. 9",
       .touches = {{Ledger::shaft,
                    "harmonics of the sun's turn against the carrier, 120 of 121 input turns, "
                    "most where the planets add up"}},
       .must_not_touch = {{Ledger::shaft, "the planets' turn, the lobe pass"},
                          {Ledger::quasi_static, "means"}},
       .mimics = {"misalignment", "gear_eccentricity"},
       .experiment = "a longer record: 120/121 and 240/121 part from the shaft's own 1 and 2"},
      "planet_mesh", false, {deviation_card("sun_tooth_error"), phase_card("sun_tooth_phase")});
}

}  // namespace rvbench::sim
