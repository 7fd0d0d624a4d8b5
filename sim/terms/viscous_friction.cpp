#include "sim/terms/viscous_friction.hpp"

namespace rvbench::sim {

TermType viscous_friction() {
  return {.card = {.name = "viscous_friction",
                   .equation = "F = b·v",
                   .sign = "b >= 0 opposes motion",
                   .leaves_out = "shear thinning, temperature",
                   .source = "Armstrong-Hélouvry et al., Automatica 30(7), 1083-1138 (1994), §2",
                   .touches = {{Ledger::quasi_static, "torque mean, in proportion to speed"},
                               {Ledger::fixed_frequency, "width of the resonances"}},
                   .must_not_touch = {{Ledger::quasi_static, "growth with load"},
                                      {Ledger::shaft, "lines of the shaft at constant speed"}},
                   .mimics = {"shear_thinning", "thermal_viscosity", "nonlinear_damping"},
                   .experiment = "six speeds including creep: only this one is straight"},
          .parameters = {{.name = "damping",
                          .unit = UnitKind::damping,
                          .min = 0,
                          .max = unbounded,
                          .start = 0.1}},
          .make = [](const TermSite& at) {
            return std::make_unique<LinearAxisTerm>("viscous_friction", at.axis, 0, at["damping"]);
          }};
}

}  // namespace rvbench::sim
