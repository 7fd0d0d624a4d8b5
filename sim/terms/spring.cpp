#include "sim/terms/spring.hpp"

namespace rvbench::sim {

TermType spring() {
  return {.card = {.name = "spring",
                   .effect = false,
                   .equation = "F = k·x, x = q_a − q_b",
                   .sign = "k > 0 pulls back",
                   .leaves_out = "its mass; its damping: put a damper beside it",
                   .source = "Rao, Mechanical Vibrations, ch. 1"},
          .parameters = {{.name = "stiffness",
                          .unit = UnitKind::stiffness,
                          .min = 0,
                          .max = unbounded,
                          .start = 1}},
          .make = [](const TermSite& at) {
            return std::make_unique<LinearAxisTerm>("spring", at.axis, at["stiffness"], 0);
          }};
}

}  // namespace rvbench::sim
