#include "sim/terms/shaft_torsion.hpp"

namespace rvbench::sim {

TermType shaft_torsion() {
  return {.card = {.name = "shaft_torsion",
                   .effect = false,
                   .equation = "F = k·x + c·v, x = q_a − q_b",
                   .sign = "k > 0 pulls back, c > 0 brakes",
                   .leaves_out = "backlash, hysteresis of a rubber coupling, its mass",
                   .source = "Rao, Mechanical Vibrations, ch. 1"},
          .parameters = {{.name = "stiffness",
                          .unit = UnitKind::stiffness,
                          .min = 0,
                          .max = unbounded,
                          .start = 1},
                         {.name = "damping",
                          .unit = UnitKind::damping,
                          .min = 0,
                          .max = unbounded,
                          .start = 0.05}},
          .gate = {.translation = false, .on_one = false},
          .make = [](const TermSite& at) {
            return std::make_unique<LinearAxisTerm>("shaft_torsion", at.axis, at["stiffness"],
                                                    at["damping"]);
          }};
}

}  // namespace rvbench::sim
