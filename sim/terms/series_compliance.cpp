#include "sim/terms/series_compliance.hpp"

#include "sim/effect_edits.hpp"

namespace rvbench::sim {
namespace {

PlantSpec insert(PlantSpec plant, const EffectSite& site, const Parameters& parameters) {
  return split_body(std::move(plant), site,
                    {.effect = "series_compliance",
                     .share = parameters.at("far_share").value,
                     .stiffness = parameters.at("stiffness").value,
                     .damping = parameters.at("damping").value});
}

}  // namespace

TermType series_compliance() {
  return {.card = {.name = "series_compliance",
                   .equation = "F = k·(q − q_far) + c·(v − v_far), inertia J·(1 − s) and J·s",
                   .sign = "k > 0; 1/k is the compliance",
                   .leaves_out = "more than one mode",
                   .source = "Spong, J. Dyn. Syst. Meas. Control 109(4), 310-318 (1987)",
                   .touches = {{Ledger::fixed_frequency, "resonance and anti-resonance"},
                               {Ledger::transient, "lag and ringing after steps of the drive"}},
                   .must_not_touch = {{Ledger::quasi_static, "torque mean at constant speed"}},
                   .mimics = {"torsional_mode", "backlash"},
                   .experiment = "multisine of the drive: anti-resonance in the drive's own speed"},
          .parameters = {{.name = "stiffness",
                          .unit = UnitKind::stiffness,
                          .min = smallest,
                          .max = unbounded,
                          .start = 30},
                         {.name = "damping",
                          .unit = UnitKind::damping,
                          .min = 0,
                          .max = unbounded,
                          .start = 0.2,
                          .fallback = 0},
                         {.name = "far_share",
                          .unit = UnitKind::ratio,
                          .min = 0.001,
                          .max = 0.999,
                          .start = 0.5}},
          .gate = {.between_two = false},
          .edit = insert};
}

}  // namespace rvbench::sim
