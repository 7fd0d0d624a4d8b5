#include "sim/retuning.hpp"

#include <stdexcept>
#include <utility>

#include "hal/types/units.hpp"

namespace rvbench::sim {
namespace {

constexpr double usual_deviation_m = 3e-6;  // of gear teeth and pins of accuracy class 5 or 6
constexpr double narrow_place_rad = 0.05;   // a fifth of a tooth of 27: what a place can be told by

}  // namespace

TermType retuning(TermCard card, std::string of_type, bool each,
                  std::vector<ParameterCard> parameters) {
  TermType type;
  type.card = std::move(card);
  type.parameters = std::move(parameters);
  type.gate.retunes = of_type;
  type.gate.each = each;
  type.edit = [of_type = std::move(of_type)](PlantSpec plant, const EffectSite& site,
                                             const Parameters& values) {
    bool any = false;
    for (TermSpec& term : plant.terms) {
      if (term.type != of_type || (!site.reference.empty() && term.name != site.reference))
        continue;
      any = true;
      for (const auto& [name, quantity] : values) term.parameters[name] = quantity;
    }
    if (!any) throw std::invalid_argument("the plant has no " + of_type + " to deviate");
    return plant;
  };
  return type;
}

ParameterCard deviation_card(std::string name) {
  return {.name = std::move(name),
          .unit = UnitKind::length,
          .min = 0,
          .max = unbounded,
          .start = usual_deviation_m};
}

ParameterCard place_card(std::string name) {
  return {.name = std::move(name),
          .unit = UnitKind::angle,
          .min = -unbounded,
          .max = unbounded,
          .start = narrow_place_rad};
}

ParameterCard phase_card(std::string name) {
  return {.name = std::move(name),
          .unit = UnitKind::angle,
          .min = -unbounded,
          .max = unbounded,
          .start = 0,
          .is_phase = true};
}

}  // namespace rvbench::sim
