#include "sim/terms/inverter_ripple.hpp"

#include "sim/terms/periodic_push.hpp"

namespace rvbench::sim {
TermType inverter_ripple() {
  return {
      .card = {.name = "inverter_ripple",
               .equation = "F = −(A·cos 2πh·f_e·t + B·sin 2πh·f_e·t)",
               .sign = "A > 0 pushes forward at t = 0",
               .leaves_out = "dependence on current and flux, drift of f_e in a record",
               .source = "Fitzgerald, Electric Machinery, ch. 6",
               .touches = {{Ledger::electrical,
                            "6·f_e and 12·f_e, in torque more than in "
                            "acceleration"}},
               .must_not_touch = {{Ledger::shaft, "lines at k/121 of input speed"},
                                  {Ledger::quasi_static, "means"}},
               .mimics = {"pin_ripple", "external_force"},
               .experiment = "coast down: it is gone at once; change the load: its order moves"},
      .parameters = {push_card("cosine"),
                     push_card("sine"),
                     {.name = "electrical_frequency",
                      .unit = UnitKind::frequency,
                      .min = 0,
                      .max = 1e4,
                      .start = 1},
                     {.name = "harmonic",
                      .unit = UnitKind::ratio,
                      .min = 1,
                      .max = 100,
                      .start = 6,
                      .fallback = 6,
                      .fitted = false}},
      .make = [](const TermSite& at) {
        return std::make_unique<PeriodicPush>("inverter_ripple", at.axis, at["cosine"], at["sine"],
                                              at["harmonic"] * at["electrical_frequency"]);
      }};
}

}  // namespace rvbench::sim
