#include "sim/terms/damper.hpp"

namespace rvbench::sim {

TermType damper() {
  return {.card = {.name = "damper",
                   .effect = false,
                   .equation = "F = c·v, v = v_a − v_b",
                   .sign = "c > 0 brakes",
                   .leaves_out = "dependence on temperature and load",
                   .source = "Rao, Mechanical Vibrations, ch. 1"},
          .parameters = {{.name = "damping",
                          .unit = UnitKind::damping,
                          .min = 0,
                          .max = unbounded,
                          .start = 0.05}},
          .make = [](const TermSite& at) {
            return std::make_unique<LinearAxisTerm>("damper", at.axis, 0, at["damping"]);
          }};
}

}  // namespace rvbench::sim
