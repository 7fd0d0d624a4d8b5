#include "sim/terms/external_force.hpp"

#include "sim/terms/periodic_push.hpp"

namespace rvbench::sim {
TermType external_force() {
  return {
      .card = {.name = "external_force",
               .equation = "F = −(A·cos 2πft + B·sin 2πft)",
               .sign = "A > 0 pushes forward at t = 0",
               .leaves_out = "harmonics, drift of the frequency",
               .source = "Rao, Mechanical Vibrations, ch. 3",
               .touches = {{Ledger::fixed_frequency, "one line at f, at all speeds and loads"}},
               .must_not_touch = {{Ledger::shaft, "lines that follow the speed"},
                                  {Ledger::quasi_static, "means"}},
               .mimics = {"mains_hum", "inverter_ripple", "housing_mode"},
               .experiment = "change the speed: it stays; stand still: it stays"},
      .parameters =
          {push_card("cosine"),
           push_card("sine"),
           {.name = "frequency", .unit = UnitKind::frequency, .min = 0, .max = 1e6, .start = 1}},
      .make = [](const TermSite& at) {
        return std::make_unique<PeriodicPush>("external_force", at.axis, at["cosine"], at["sine"],
                                              at["frequency"]);
      }};
}

}  // namespace rvbench::sim
