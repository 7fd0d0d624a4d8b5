#include "sim/term_library.hpp"

#include <algorithm>
#include <stdexcept>

#include "sim/effect_edits.hpp"
#include "sim/effect_sites.hpp"
#include "sim/terms/asymmetric_friction.hpp"
#include "sim/terms/backlash.hpp"
#include "sim/terms/bearing_defect.hpp"
#include "sim/terms/brake_ripple.hpp"
#include "sim/terms/cascade_controller.hpp"
#include "sim/terms/coulomb_friction.hpp"
#include "sim/terms/crank_eccentricity.hpp"
#include "sim/terms/cubic_stiffness.hpp"
#include "sim/terms/cycloid_stage.hpp"
#include "sim/terms/damper.hpp"
#include "sim/terms/displacement_damping.hpp"
#include "sim/terms/external_force.hpp"
#include "sim/terms/gear_eccentricity.hpp"
#include "sim/terms/gravity.hpp"
#include "sim/terms/holding_brake.hpp"
#include "sim/terms/housing_mode.hpp"
#include "sim/terms/induction_motor.hpp"
#include "sim/terms/inverter_ripple.hpp"
#include "sim/terms/load_friction.hpp"
#include "sim/terms/looseness.hpp"
#include "sim/terms/mains_hum.hpp"
#include "sim/terms/mesh_stiffness_variation.hpp"
#include "sim/terms/misalignment.hpp"
#include "sim/terms/motor.hpp"
#include "sim/terms/nonlinear_damping.hpp"
#include "sim/terms/pin_ripple.hpp"
#include "sim/terms/planet_mesh.hpp"
#include "sim/terms/quadratic_stiffness.hpp"
#include "sim/terms/rolling_bearing.hpp"
#include "sim/terms/rotor_bar.hpp"
#include "sim/terms/saturation.hpp"
#include "sim/terms/sensor_mount.hpp"
#include "sim/terms/series_compliance.hpp"
#include "sim/terms/shaft_torsion.hpp"
#include "sim/terms/shear_thinning.hpp"
#include "sim/terms/slip.hpp"
#include "sim/terms/speed_modulation.hpp"
#include "sim/terms/spring.hpp"
#include "sim/terms/stiffness_hysteresis.hpp"
#include "sim/terms/stribeck_friction.hpp"
#include "sim/terms/sun_tooth_error.hpp"
#include "sim/terms/thermal_viscosity.hpp"
#include "sim/terms/tooth_damage.hpp"
#include "sim/terms/torque_offset.hpp"
#include "sim/terms/torsional_mode.hpp"
#include "sim/terms/transmission_error.hpp"
#include "sim/terms/unbalance.hpp"
#include "sim/terms/viscous_friction.hpp"

namespace rvbench::sim {
namespace {

TermLibrary make_standard_terms() {
  TermLibrary library;
  for (const auto& make : {spring,
                           damper,
                           gravity,
                           motor,
                           cascade_controller,
                           coulomb_friction,
                           viscous_friction,
                           asymmetric_friction,
                           stribeck_friction,
                           load_friction,
                           shear_thinning,
                           thermal_viscosity,
                           backlash,
                           looseness,
                           series_compliance,
                           torsional_mode,
                           cubic_stiffness,
                           quadratic_stiffness,
                           nonlinear_damping,
                           displacement_damping,
                           stiffness_hysteresis,
                           torque_offset,
                           external_force,
                           saturation,
                           unbalance,
                           inverter_ripple,
                           rotor_bar,
                           speed_modulation,
                           brake_ripple,
                           misalignment,
                           transmission_error,
                           mesh_stiffness_variation,
                           gear_eccentricity,
                           tooth_damage,
                           sun_tooth_error,
                           pin_ripple,
                           crank_eccentricity,
                           bearing_defect,
                           shaft_torsion,
                           induction_motor,
                           holding_brake,
                           planet_mesh,
                           cycloid_stage,
                           rolling_bearing,
                           synchronous_drive,
                           slip,
                           housing_mode,
                           sensor_mount,
                           mains_hum}) {
    library.add(make());
  }
  return library;
}

[[noreturn]] void refuse(std::string_view effect, const std::string& why) {
  throw std::invalid_argument("with_effect: " + std::string(effect) + ": " + why);
}

}  // namespace

double TermSite::operator[](std::string_view parameter) const {
  const auto found = parameters->find(parameter);
  if (found == parameters->end()) {
    throw std::logic_error("TermSite: no parameter " + std::string(parameter));
  }
  return found->second.value;
}

void TermLibrary::add(TermType type) {
  if (find(type.card.name) != nullptr) {
    throw std::invalid_argument("TermLibrary: there is already a type " + type.card.name);
  }
  types_.push_back(std::move(type));
}

const TermType* TermLibrary::find(std::string_view name) const {
  const auto found = std::find_if(types_.begin(), types_.end(),
                                  [&](const TermType& t) { return t.card.name == name; });
  return found == types_.end() ? nullptr : &*found;
}

std::vector<std::string> TermLibrary::names() const {
  std::vector<std::string> names;
  for (const TermType& type : types_) names.push_back(type.card.name);
  return names;
}

const TermLibrary& standard_terms() {
  static const TermLibrary library = make_standard_terms();
  return library;
}

PlantSpec with_effect(const PlantSpec& plant, std::string_view effect, const EffectSite& site,
                      const Parameters& parameters, const TermLibrary& library) {
  const TermType* type = library.find(effect);
  if (type == nullptr) refuse(effect, "the library has no such effect");
  const bool on_body = site.reference.empty() && site.channel.empty();
  if (on_body && plant.find_body(site.body_a) == nullptr) {
    refuse(effect, "the plant has no body \"" + site.body_a + '"');
  }
  Parameters complete = parameters;
  for (const ParameterCard& card : type->parameters) {
    if (!card.fallback || complete.contains(card.name)) continue;
    complete[card.name] = {*card.fallback, unit_at(plant, site, card.unit), 0};
  }
  EffectSite place = site;  // an edit does not know the library
  if (type->gate.stands && place.beyond.empty()) {
    place.beyond = holding(plant, site.body_a, library);
  }
  if (type->edit) return type->edit(plant, place, complete);
  PlantSpec changed = plant;
  changed.terms.push_back({free_name(plant, type->card.name), type->card.name, site.body_a,
                           site.body_b, site.reference, std::move(complete)});
  return changed;
}

}  // namespace rvbench::sim
