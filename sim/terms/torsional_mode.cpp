#include "sim/terms/torsional_mode.hpp"

#include "hal/types/units.hpp"
#include "sim/effect_edits.hpp"

namespace rvbench::sim {
namespace {

PlantSpec attach(PlantSpec plant, const EffectSite& site, const Parameters& parameters) {
  const BodySpec* body = plant.find_body(site.body_a);
  const double share = parameters.at("inertia_share").value;
  const double inertia = body == nullptr ? 0 : share * body->inertia.value;
  const double omega_rad_s = units::two_pi * parameters.at("frequency").value;
  const double damping_ratio = parameters.at("damping_ratio").value;
  return split_body(std::move(plant), site,
                    {.effect = "torsional_mode",
                     .share = share,
                     .stiffness = omega_rad_s * omega_rad_s * inertia,
                     .damping = 2 * damping_ratio * omega_rad_s * inertia});
}

}  // namespace

TermType torsional_mode() {
  return {.card = {.name = "torsional_mode",
                   .equation = "J·s on k = (2πf)²·J·s and c = 2ζ·2πf·J·s beside J·(1 − s)",
                   .sign = "f > 0, 0 < s < 1",
                   .leaves_out = "more than one mode, dependence on load",
                   .source = "Rao, Mechanical Vibrations, ch. 9.11",
                   .touches = {{Ledger::shaft, "gain and phase near f, at the speeds that meet it"},
                               {Ledger::transient, "ringing at f"}},
                   .must_not_touch = {{Ledger::quasi_static, "torque mean at constant speed"}},
                   .mimics = {"series_compliance", "housing_mode", "speed_modulation"},
                   .experiment = "run-up or multisine; change of the controller's gain moves its "
                                 "loop's mode but not this one"},
          .parameters = {{.name = "inertia_share",
                          .unit = UnitKind::ratio,
                          .min = 1e-4,
                          .max = 0.9,
                          .start = 0.3},
                         resonance_card(3),
                         damping_ratio_card(0.03)},
          .gate = {.between_two = false},
          .edit = attach,
          .adds = true};
}

}  // namespace rvbench::sim
