#include "sim/terms/bearing_defect.hpp"

#include "sim/retuning.hpp"
#include "sim/terms/rolling_bearing.hpp"

namespace rvbench::sim {

TermType bearing_defect() {
  const auto number = [](BearingPart part) { return static_cast<double>(part); };
  TermType type = retuning(
      {.name = "bearing_defect",
       .equation =
           "F = −√(1 + a₁·cos νφ + a₂·cos 2νφ)·Σ P(t − t_i), P half a sine of impulse J over "
           "τ, t_i each pass of the spall, νφ its way through the load zone",
       .sign = "J >= 0 strikes towards growing ways",
       .leaves_out = "a second spall on the same bearing, slip",
       .source = "McFadden & Smith, J. Sound Vib. 96(1), 69-82 (1984)",
       .touches = {{Ledger::broadband, "envelope lines at the part's passes and their harmonics"}},
       .must_not_touch = {{Ledger::shaft, "lines that stay after averaging over turns"},
                          {Ledger::quasi_static, "means"}},
       .mimics = {"tooth_damage", "looseness"},
       .experiment =
           "envelope over a longer record: passes of the races and of the rolling elements part; "
           "average over the period of the teeth: gears stay, bearings go"},
      "rolling_bearing", true,
      {{.name = "impact_impulse",
        .unit = UnitKind::impulse,
        .min = 0,
        .max = unbounded,
        .start = 2e-3,
        .fallback = 0},
       {.name = "impact_scatter", .min = 0, .max = 0.3, .start = 0.04, .fitted = false},
       {.name = "impact_time",
        .unit = UnitKind::time,
        .min = 1e-5,
        .max = 1e-3,
        .start = 1e-4,
        .fitted = false},
       {.name = "spalled_part",
        .min = 1,
        .max = 3,
        .start = 1,
        .choices = {{number(BearingPart::outer_race), "outer race"},
                    {number(BearingPart::inner_race), "inner race"},
                    {number(BearingPart::rolling_element), "rolling element"}}}});
  type.shows_in = {ComparedBy::envelope};
  return type;
}

}  // namespace rvbench::sim
