#include "analysis/indicators/envelope_levels.hpp"

#include <cmath>
#include <optional>

#include "analysis/indicators/indicator_places.hpp"
#include "analysis/indicators/order_levels.hpp"
#include "analysis/order/resolution.hpp"
#include "hal/types/measure.hpp"

namespace rvbench::analysis {

EnvelopeLevels::EnvelopeLevels(const Kinematics& kinematics, double speed_error) {
  for (const CharacteristicOrder& o : kinematics.orders) {
    const double slip = slip_of(o, kinematics);
    places_.push_back({.name = o.name,
                       .order = o.order,
                       .within = (slip + speed_error) * o.order,
                       .rolls = slip > 0});
  }
}

void EnvelopeLevels::add(const EnvelopeSpectra& envelope, double share) {
  if (!(envelope.mean > 0)) return;
  const double step = envelope.whole.resolution;
  const Spectrum unlocked{step, envelope.unlocked.power.cwiseSqrt()};
  for (Place& place : places_) {
    if (place.order + place.within >= envelope.highest_order) continue;
    if (!are_parted(place.order - place.within, 0, 1 / step)) continue;
    const std::optional<double> level =
        level_at_order(place.rolls ? unlocked : envelope.whole, place.order, place.within);
    if (!level) continue;
    place.is_reached = true;
    place.depth2 += share * std::pow(*level / envelope.mean, 2);
  }
}

std::vector<Indicator> EnvelopeLevels::indicators() const {
  std::vector<Indicator> list;
  for (const Place& place : places_) {
    if (!place.is_reached) continue;
    list.push_back({std::string(measure_names::envelope_order_level), place.name,
                    std::sqrt(place.depth2), "1"});
  }
  return list;
}

}  // namespace rvbench::analysis
