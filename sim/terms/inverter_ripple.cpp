#include "sim/terms/inverter_ripple.hpp"

#include "sim/retuning.hpp"

namespace rvbench::sim {

TermType inverter_ripple() {
  return retuning(
      {.name = "inverter_ripple",
       .equation = "T = T_motor·(1 + ρ·cos 6φ_e), dφ_e/dt = 2π·f_e",
       .sign = "ρ >= 0 is the relative amplitude",
       .leaves_out = "12·f_e and above, what the carrier frequency adds",
       .source = "Fitzgerald, Electric Machinery, ch. 6; 5th and 7th harmonic currents make 6·f_e",
       .touches = {{Ledger::electrical, "6·f_e, in torque more than in acceleration"}},
       .must_not_touch = {{Ledger::shaft, "lines at k/121 of input speed"},
                          {Ledger::quasi_static, "means"}},
       .mimics = {"pin_ripple", "external_force"},
       .experiment = "coast down: it is gone at once; change the load: its order moves"},
      "induction_motor", true,
      {{.name = "ripple", .unit = UnitKind::ratio, .min = 0, .max = 1, .start = 0.02}});
}

}  // namespace rvbench::sim
